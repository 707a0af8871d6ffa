"""MJCF as MuJoCo reads it, and SDF composed from its own text, have the panels where the box's own numbers put them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import mujoco
import numpy as np
from scipy.spatial.transform import Rotation

from boxwright.kinematics import configuration, mjcf_text, save_mjcf, save_sdf, sdf_text, urdf_text
from boxwright.kinematics.links import link_frames, root_part
from boxwright.kinematics.transforms import apply, inverse, quaternion_wxyz
from boxwright.types import Object
from support.random_models import Angles, BoxSpec, Matrix, panels, random_angles, random_object, random_spec

MODELS = 60


def cases() -> Iterator[tuple[BoxSpec, Object, Angles]]:
    rng = np.random.default_rng(409)
    for _ in range(MODELS):
        spec = random_spec(rng)
        yield spec, random_object(spec, random_angles(spec, rng)), random_angles(spec, rng)


def by_joint(angles: Angles) -> dict[str, float]:
    return {f"{part}_hinge": angle for part, angle in angles.items()}


def corners_in_links(model_object: Object) -> dict[str, Matrix]:
    frames = link_frames(model_object, root_part(model_object, None))
    return {n: apply(inverse(frames[n]), np.array(model_object.part(n).corners)) for n in frames}


def test_mujoco_starts_as_measured_and_turns_as_the_box() -> None:
    counted, worst = 0, 0.0
    for spec, model_object, angles in cases():
        model = mujoco.MjModel.from_xml_string(mjcf_text(model_object))
        data, local = mujoco.MjData(model), corners_in_links(model_object)
        assert {model.body(i).name for i in range(1, model.nbody)} == set(local)
        for name, position in configuration(model_object).items():
            assert data.joint(name).qpos[0] == position
            np.testing.assert_allclose(model.joint(name).range, _limits(model_object, name), atol=1e-12)
        for wanted, positions in (
            ({name: np.array(model_object.part(name).corners) for name in local}, configuration(model_object)),
            (panels(spec, angles), by_joint(angles)),
            (panels(spec, dict.fromkeys(angles, 0.0)), dict.fromkeys(by_joint(angles), 0.0)),
        ):
            for name, angle in positions.items():
                data.joint(name).qpos[0] = angle
            mujoco.mj_kinematics(model, data)
            for name, corners in local.items():
                body = data.body(name)
                found = corners @ body.xmat.reshape(3, 3).T + body.xpos
                worst = max(worst, float(np.abs(found - wanted[name]).max()))
                counted += 1
        if model.nkey:
            assert not model.key("closed").qpos.any()
    assert counted > 1000
    assert worst < 1e-9


def test_mjcf_and_urdf_weigh_the_same() -> None:
    counted = 0
    for _, model_object, _ in cases():
        ours, theirs = (mujoco.MjModel.from_xml_string(text(model_object)) for text in (mjcf_text, urdf_text))
        for i in range(1, ours.nbody):
            name = ours.body(i).name
            np.testing.assert_allclose(ours.body(name).mass, theirs.body(name).mass, rtol=1e-9)
            np.testing.assert_allclose(ours.body(name).inertia, theirs.body(name).inertia, rtol=1e-6)
            counted += 1
    assert counted > 300


def test_a_free_box_falls_and_its_own_hinges_do_not_collide() -> None:
    rng = np.random.default_rng(5)
    spec = random_spec(rng)
    model = mujoco.MjModel.from_xml_string(mjcf_text(random_object(spec, random_angles(spec, rng)), free=True))
    data = mujoco.MjData(model)
    before = data.qpos[:3].copy()
    for _ in range(100):
        mujoco.mj_step(model, data)
    assert np.linalg.norm(data.qpos[:3] - before) > 0.01
    assert model.nexclude == len(spec.flaps) + sum(flap.tuck_width is not None for flap in spec.flaps)


def test_sdf_puts_the_panels_where_the_box_does() -> None:
    counted, worst = 0, 0.0
    for spec, model_object, angles in cases():
        model = ET.fromstring(sdf_text(model_object)).find("model")
        assert model is not None
        local, truth, positions = corners_in_links(model_object), panels(spec, angles), by_joint(angles)
        assert {link.get("name") for link in model.iter("link")} == set(local)
        for name in local:
            found = apply(_input_from_link(model, name, positions), local[name])
            worst = max(worst, float(np.abs(found - truth[name]).max()))
            counted += 1
        ties = {joint.findtext("child") for joint in model.iter("joint")}
        assert ties == set(local) - {model.get("canonical_link")}
    assert counted > 350
    assert worst < 1e-9


def test_sdf_tells_limits_masses_and_boxes() -> None:
    counted = 0
    for _, model_object, _ in cases():
        model = ET.fromstring(sdf_text(model_object)).find("model")
        assert model is not None
        mujocos = mujoco.MjModel.from_xml_string(mjcf_text(model_object))
        for joint in model_object.joints:
            (element,) = [j for j in model.iter("joint") if j.get("name") == joint.name]
            limits = [float(element.findtext(f"axis/limit/{end}", "nan")) for end in ("lower", "upper")]
            assert limits == list(joint.limits)
        for link in model.iter("link"):
            name = str(link.get("name"))
            assert float(link.findtext("inertial/mass", "nan")) == mujocos.body(name).mass[0]
            size = np.array(link.findtext("collision/geometry/box/size", "").split(), dtype=float)
            np.testing.assert_allclose(size / 2.0, mujocos.geom(name).size)
            counted += 1
    assert counted > 300


def test_files_are_the_texts(tmp_path: Path) -> None:
    rng = np.random.default_rng(6)
    spec = random_spec(rng)
    model_object = random_object(spec, random_angles(spec, rng))
    save_mjcf(model_object, tmp_path / "box.xml")
    save_sdf(model_object, tmp_path / "box.sdf")
    assert (tmp_path / "box.xml").read_text(encoding="utf-8") == mjcf_text(model_object)
    assert (tmp_path / "box.sdf").read_text(encoding="utf-8") == sdf_text(model_object)
    mujoco.MjModel.from_xml_path(str(tmp_path / "box.xml"))


def test_quaternions_turn_as_scipy_s_do() -> None:
    rng = np.random.default_rng(7)
    turns = [*Rotation.random(300, random_state=rng).as_matrix(), *(np.diag(d) for d in np.eye(3) * 2 - 1)]
    for turn in turns:
        pose = np.eye(4)
        pose[:3, :3] = turn
        w, x, y, z = quaternion_wxyz(pose)
        assert w >= 0.0
        np.testing.assert_allclose(Rotation.from_quat([x, y, z, w]).as_matrix(), turn, atol=1e-12)
    assert len(turns) == 303


def _limits(model_object: Object, name: str) -> tuple[float, float]:
    return next(joint.limits for joint in model_object.joints if joint.name == name)


def _input_from_link(model: ET.Element, name: str, positions: dict[str, float]) -> Matrix:
    """By SDF's rules: a link stands in the model's frame where its joints are at 0; an axis is told in the child's."""
    (link,) = [link for link in model.iter("link") if link.get("name") == name]
    zero = _pose(link.findtext("pose", ""))
    (tie,) = [joint for joint in model.iter("joint") if joint.findtext("child") == name] or [None]
    if tie is None or tie.get("type") == "fixed":
        return zero
    parent = str(tie.findtext("parent"))
    (parent_link,) = [link for link in model.iter("link") if link.get("name") == parent]
    axis = np.array(tie.findtext("axis/xyz", "").split(), dtype=float)
    turn = np.eye(4)
    turn[:3, :3] = Rotation.from_rotvec(axis * positions[str(tie.get("name"))]).as_matrix()
    parent_from_link = inverse(_pose(parent_link.findtext("pose", ""))) @ zero
    return _input_from_link(model, parent, positions) @ parent_from_link @ turn


def _pose(text: str) -> Matrix:
    x, y, z, roll, pitch, yaw = map(float, text.split())
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", [roll, pitch, yaw]).as_matrix()
    pose[:3, 3] = [x, y, z]
    return pose
