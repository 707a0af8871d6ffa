"""Where panels go: our kinematics, yourdfpy's and MuJoCo's of the written URDF, and the box's own numbers agree."""

from __future__ import annotations

import io
from collections.abc import Iterator

import mujoco
import numpy as np
import pytest
import yourdfpy
from scipy.spatial.transform import Rotation

from boxwright.kinematics import configuration, hinge_lines, part_corners, urdf_text
from boxwright.kinematics.links import link_frames, root_part
from boxwright.kinematics.transforms import apply, inverse
from boxwright.types import Object
from support.random_models import Angles, BoxSpec, Matrix, loosened, panels, random_angles, random_object, random_spec

MODELS = 60
POSITIONS_EACH = 3


def cases() -> Iterator[tuple[BoxSpec, Object, Angles]]:
    rng = np.random.default_rng(20111)
    for _ in range(MODELS):
        spec = random_spec(rng)
        yield spec, random_object(spec, random_angles(spec, rng)), random_angles(spec, rng)
        for _ in range(POSITIONS_EACH - 1):
            yield spec, random_object(spec, random_angles(spec, rng)), random_angles(spec, rng)


def by_joint(angles: Angles) -> dict[str, float]:
    return {f"{part}_hinge": angle for part, angle in angles.items()}


def placed_names(model_object: Object) -> set[str]:
    return {part.name for part in model_object.parts if part.corners is not None}


def test_forward_kinematics_agrees_with_the_box() -> None:
    count = 0
    for spec, model_object, angles in cases():
        truth = panels(spec, angles)
        moved = part_corners(model_object, by_joint(angles))
        assert set(moved) == placed_names(model_object)
        for name, corners in moved.items():
            np.testing.assert_allclose(corners, truth[name], atol=1e-12)
        for name, (origin, axis) in hinge_lines(model_object, by_joint(angles)).items():
            edge = truth[name.removesuffix("_hinge")][:2]
            sign = -1.0 if name.startswith("tuck") else 1.0
            np.testing.assert_allclose(origin, edge.mean(axis=0), atol=1e-12)
            np.testing.assert_allclose(axis * np.linalg.norm(edge[1] - edge[0]), sign * (edge[1] - edge[0]), atol=1e-12)
        count += 1
    assert count == MODELS * POSITIONS_EACH


def test_at_the_measured_positions_nothing_moves() -> None:
    for _, model_object, _ in cases():
        for positions in (configuration(model_object), {}):
            for name, corners in part_corners(model_object, positions).items():
                np.testing.assert_allclose(corners, np.array(model_object.part(name).corners), atol=1e-13)


def corners_in_links(model_object: Object) -> dict[str, Matrix]:
    """Each panel's corners in its link's frame."""
    frames = link_frames(model_object, root_part(model_object, None))
    return {n: apply(inverse(frames[n]), np.array(model_object.part(n).corners)) for n in frames}


def test_yourdfpy_agrees() -> None:
    count, worst = 0, 0.0
    for spec, model_object, angles in cases():
        robot = yourdfpy.URDF.load(io.StringIO(urdf_text(model_object)), load_meshes=False)
        root = root_part(model_object, None)
        input_from_root = link_frames(model_object, root)[root]
        truth, local = panels(spec, angles), corners_in_links(model_object)
        assert set(robot.link_map) == placed_names(model_object)
        robot.update_cfg(by_joint(angles))
        for name in robot.link_map:
            found = apply(input_from_root @ robot.get_transform(name, root), local[name])
            worst = max(worst, float(np.abs(found - truth[name]).max()))
        count += 1
    assert count == MODELS * POSITIONS_EACH
    assert worst < 1e-9


def test_mujoco_agrees_and_keeps_every_panel_a_body() -> None:
    count, worst = 0, 0.0
    for spec, model_object, angles in cases():
        model = mujoco.MjModel.from_xml_string(urdf_text(model_object))
        data = mujoco.MjData(model)
        bodies = {model.body(i).name for i in range(1, model.nbody)}
        assert bodies == placed_names(model_object)
        assert {model.joint(i).name for i in range(model.njnt)} == set(by_joint(angles))
        for name, angle in by_joint(angles).items():
            data.joint(name).qpos[0] = angle
        mujoco.mj_forward(model, data)
        root = root_part(model_object, None)
        input_from_root = link_frames(model_object, root)[root]
        truth, local = panels(spec, angles), corners_in_links(model_object)
        for name in bodies:
            body = data.body(name)
            in_world = local[name] @ body.xmat.reshape(3, 3).T + body.xpos
            worst = max(worst, float(np.abs(apply(input_from_root, in_world) - truth[name]).max()))
        count += 1
    assert count == MODELS * POSITIONS_EACH
    assert worst < 1e-6


def test_mujoco_sees_plausible_inertias_and_the_limits() -> None:
    count = 0
    for _, model_object, _ in cases():
        model = mujoco.MjModel.from_xml_string(urdf_text(model_object))
        for i in range(1, model.nbody):
            a, b, c = sorted(model.body_inertia[i])
            assert 0.0 < a <= b <= c < a + b
            assert model.body_mass[i] > 0.0
        for joint in model_object.joints:
            assert model.joint(joint.name).limited
            np.testing.assert_allclose(model.joint(joint.name).range, joint.limits, atol=1e-12)
            count += 1
    assert count > 500


def test_the_box_of_a_rectangle_is_the_rectangle() -> None:
    """The visual box, placed by yourdfpy, has the panel's own corners at mid-board: ties the URDF to the truth."""
    count = 0
    for spec, model_object, angles in cases():
        robot = yourdfpy.URDF.load(io.StringIO(urdf_text(model_object)), load_meshes=False)
        robot.update_cfg(by_joint(angles))
        root = root_part(model_object, None)
        input_from_root = link_frames(model_object, root)[root]
        truth = panels(spec, angles)
        rectangles = [f"side_{k}" for k in range(4)]
        rectangles += [f"flap_{f.side}" for f in spec.flaps if f.taper_start == f.taper_end == 0.0]
        for name in rectangles:
            for shown in (robot.link_map[name].visuals[0], robot.link_map[name].collisions[0]):
                size = np.array(shown.geometry.box.size)
                signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
                input_from_box = input_from_root @ robot.get_transform(name, root) @ shown.origin
                np.testing.assert_allclose(apply(input_from_box, signs * size / 2), truth[name], atol=1e-9)
                count += 1
    assert count > MODELS * POSITIONS_EACH * 4 * 2


def scipys_corners(model_object: Object, positions_rad: dict[str, float]) -> dict[str, Matrix]:
    """Corners by scipy's rotations, from the farthest joint inwards."""
    joint_of = {joint.child: joint for joint in model_object.joints}
    found = {}
    for part in model_object.parts:
        if part.corners is None:
            continue
        corners, name = np.array(part.corners), part.name
        while name in joint_of:
            joint = joint_of[name]
            turn = Rotation.from_rotvec((positions_rad[joint.name] - joint.position) * np.array(joint.axis))
            corners = turn.apply(corners - np.array(joint.origin)) + np.array(joint.origin)
            name = joint.parent
        found[part.name] = corners
    return found


def test_hinges_measured_apart_from_their_panels_move_alike_everywhere() -> None:
    rng = np.random.default_rng(20112)
    count, worst = 0, 0.0
    for _, exact, angles in cases():
        model_object = loosened(exact, rng)
        positions_rad = by_joint(angles)
        expected = scipys_corners(model_object, positions_rad)
        ours = part_corners(model_object, positions_rad)
        text, local = urdf_text(model_object), corners_in_links(model_object)
        robot = yourdfpy.URDF.load(io.StringIO(text), load_meshes=False)
        robot.update_cfg(positions_rad)
        model = mujoco.MjModel.from_xml_string(text)
        data = mujoco.MjData(model)
        for name, position_rad in positions_rad.items():
            data.joint(name).qpos[0] = position_rad
        mujoco.mj_forward(model, data)
        root = root_part(model_object, None)
        input_from_root = link_frames(model_object, root)[root]
        for name, corners in expected.items():
            body = data.body(name)
            in_world = local[name] @ body.xmat.reshape(3, 3).T + body.xpos
            by_yourdfpy = apply(input_from_root @ robot.get_transform(name, root), local[name])
            for found in (ours[name], by_yourdfpy, apply(input_from_root, in_world)):
                worst = max(worst, float(np.abs(found - corners).max()))
            count += 1
    assert count > MODELS * POSITIONS_EACH * 6
    assert worst < 1e-9


def test_an_unknown_joint_is_refused() -> None:
    _, model_object, _ = next(cases())
    with pytest.raises(ValueError, match="'lid' is no joint of this object"):
        part_corners(model_object, {"lid": 0.0})
