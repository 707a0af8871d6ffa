"""Boxes in physics before anyone touches them: their geometry, their weight, and that they stand still."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import mujoco
import numpy as np
import pytest

from boxwright.io.truth import load_truth
from boxwright.simulation.boxes import OpenBox
from boxwright.simulation.clearance import free_flaps
from boxwright.simulation.kinds import draw_box
from boxwright.simulation.panels import build_panels
from boxwright.simulation.physics import Load, PhysicsSettings, crease_class, load_creases, modelled_box, true_box
from boxwright.simulation.physics.commands import held
from boxwright.simulation.physics.matching import matched, renumbered
from boxwright.simulation.physics.moved import box_as_it_stands
from boxwright.simulation.physics.slabs import slabs_of
from boxwright.simulation.physics.stage import Stage
from boxwright.simulation.physics.state import standing_state
from boxwright.simulation.physics.world import build_world
from support.random_models import panels, random_angles, random_object, random_spec
from support.true_boxes import carton, truth_of

CATEGORIES = ("small", "medium", "large", "carton", "cake", "pizza")


def drawn_boxes(each: int) -> list[OpenBox]:
    """Boxes of every category whose boards are clear of one another; flat boards, as physics takes them."""
    rng = np.random.default_rng(6)
    boxes = []
    for category in CATEGORIES:
        found = 0
        while found < each:
            drawn = draw_box(rng, category, None)
            flaps = tuple(flap and msgspec.structs.replace(flap, bend_rad=0.0) for flap in drawn.flaps)
            box = free_flaps(rng, msgspec.structs.replace(drawn, flaps=flaps), np.eye(4))
            if box is not None:
                boxes.append(box)
                found += 1
    return boxes


def test_an_untouched_box_stands_still_and_keeps_its_flaps() -> None:
    flaps = 0
    for box in drawn_boxes(3):
        told = true_box(truth_of(box), 0, np.eye(4))
        stage = Stage(build_world(told, crease_class("pre_broken"), PhysicsSettings()), told)
        data, before = stage.data, stage.data.qpos.copy()
        stage.follow(held(np.zeros(0), 0.5, 0.001))
        flaps += len(data.qpos) - 7
        assert np.abs(data.qpos[:3] - before[:3]).max() < 0.0005
        assert np.degrees(np.abs(data.qpos[7:] - before[7:]).max(initial=0.0)) < 0.5
        assert stage.watch.max_penetration_m < 0.0002
    assert flaps > 40


def test_the_labelled_boxes_stand_still(shared_dir: Path) -> None:
    """Their truths tell no thickness and tilt some boxes on a book; the floor is where their own up says."""
    counted = 0
    for path in sorted((shared_dir / "data" / "labelled").glob("*.truth.json")):
        truth = load_truth(path)
        up = np.array(truth.up) / np.linalg.norm(truth.up)
        along = np.cross(up, [0.0, 0.0, 1.0]) / np.linalg.norm(np.cross(up, [0.0, 0.0, 1.0]))
        world_from_input = np.eye(4)
        world_from_input[:3, :3] = [along, np.cross(up, along), up]
        for k in range(len(truth.boxes)):
            box = true_box(truth, k, world_from_input)
            stage = Stage(build_world(box, crease_class("ordinary"), PhysicsSettings()), box)
            before = stage.data.qpos.copy()
            stage.follow(held(np.zeros(0), 0.2, 0.001))
            assert np.abs(stage.data.qpos[:3] - before[:3]).max() < 0.001
            assert np.degrees(np.abs(stage.data.qpos[7:] - before[7:]).max(initial=0.0)) < 0.5
            counted += 1
    assert counted == 16


def test_boards_turn_as_the_generator_builds_them() -> None:
    """The generator builds flaps straight from angles; physics turns bodies about hinges."""
    rng, counted = np.random.default_rng(7), 0
    for box in drawn_boxes(1):
        turned = tuple(
            flap
            and msgspec.structs.replace(
                flap,
                angle_rad=float(rng.uniform(0.1, 3.5)),
                tuck=flap.tuck and msgspec.structs.replace(flap.tuck, angle_rad=float(rng.uniform(-1.0, 1.5))),
            )
            for flap in box.flaps
        )
        told = true_box(truth_of(box, x_m=0.5, y_m=-0.2, yaw_rad=0.7, z_m=-0.1), 0, np.eye(4))
        there = truth_of(msgspec.structs.replace(box, flaps=turned), x_m=0.5, y_m=-0.2, yaw_rad=0.7, z_m=-0.1)
        wanted = {board.name: board for board in true_box(there, 0, np.eye(4)).boards}
        world = build_world(told, crease_class("ordinary"), PhysicsSettings())
        data = mujoco.MjData(world.model)
        for board, hinge in true_box(there, 0, np.eye(4)).hinged:
            data.qpos[world.model.joint(world.box.joint_of[board.name]).qposadr[0]] = hinge.position_rad
        mujoco.mj_kinematics(world.model, data)
        for board in box_as_it_stands(world, data, told).boards:
            np.testing.assert_allclose(board.corners, wanted[board.name].corners, atol=1e-9)
            counted += 1
    assert counted > 45


def test_slabs_cover_a_tapered_panel_and_nothing_beside_it() -> None:
    rng, counted = np.random.default_rng(5), 0
    shares = rng.uniform(0.0, 1.0, (2000, 2))
    for _ in range(40):
        wide_m, deep_m = rng.uniform(0.06, 0.4), rng.uniform(0.04, 0.3)
        left, right = rng.uniform(-0.02, 0.2, 2) * wide_m
        corners = np.array([[0.0, 0, 0], [wide_m, 0, 0], [wide_m - right, deep_m, 0], [left, deep_m, 0]])
        left_x, right_x = left * shares[:, 1], wide_m - right * shares[:, 1]
        points = np.column_stack(
            [left_x + shares[:, 0] * (right_x - left_x), deep_m * shares[:, 1], np.zeros(len(shares))]
        )
        covered = np.zeros(len(points), dtype=bool)
        for slab in slabs_of(corners, 0.004):
            local = np.abs((points - slab.centre) @ slab.axes)
            covered |= (local <= slab.half_m + 1e-9).all(axis=1)
            signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
            ends = slab.centre + (signs * slab.half_m) @ slab.axes.T
            share = ends[:, 1] / deep_m
            beside = [left * share - ends[:, 0], ends[:, 0] - wide_m + right * share, -ends[:, 1], ends[:, 1] - deep_m]
            assert max(side.max() for side in beside) < 0.0005
        assert covered.mean() > 0.98
        counted += 1
    assert counted == 40


def test_geoms_lie_where_a_tapered_flaps_slabs_do() -> None:
    told = true_box(truth_of(carton(), x_m=0.5, y_m=-0.2, yaw_rad=0.7, z_m=-0.1), 0, np.eye(4))
    flap = next(board for board, _ in told.hinged)
    corners = flap.corners.copy()
    middle = (corners[2] + corners[3]) / 2.0
    corners[2:] = middle + 0.7 * (corners[2:] - middle)
    boards = tuple(msgspec.structs.replace(b, corners=corners) if b.name == flap.name else b for b in told.boards)
    box = msgspec.structs.replace(told, boards=boards)
    world = build_world(box, crease_class("ordinary"), PhysicsSettings())
    data = standing_state(world)
    mujoco.mj_forward(world.model, data)
    body = world.model.body(world.box.body_of[flap.name])
    slabs = slabs_of(corners, box.thickness_m)
    assert len(slabs) > 3
    for slab, geom in zip(slabs, range(int(body.geomadr[0]), int(body.geomadr[0]) + len(slabs)), strict=True):
        np.testing.assert_allclose(data.geom_xpos[geom], slab.centre, atol=1e-6)
        np.testing.assert_allclose(data.geom_xmat[geom].reshape(3, 3), slab.axes, atol=1e-6)


def test_weights_are_those_of_board_and_contents() -> None:
    box = true_box(truth_of(carton()), 0, np.eye(4))
    area = sum(np.linalg.norm(np.cross(*(p.corners[[2, 3]] - p.corners[[0, 1]]))) / 2.0 for p in build_panels(carton()))
    for load, contents in ((Load(empty=True), 0.0), (Load(mass_kg=3.0), 3.0 - 0.55 * area)):
        contents_kg = load.contents_kg(box, PhysicsSettings())
        world = build_world(box, crease_class("ordinary"), PhysicsSettings(), contents_kg=contents_kg)
        assert contents_kg == pytest.approx(contents)
        assert world.model.body_subtreemass[world.model.body("box").id] == pytest.approx(0.55 * area + contents)
    with pytest.raises(ValueError, match="the boards alone weigh"):
        Load(mass_kg=0.05).contents_kg(box, PhysicsSettings())


def test_the_truth_tells_the_boards_thickness_and_an_option_goes_before() -> None:
    truth = truth_of(carton())
    assert true_box(truth, 0, np.eye(4)).thickness_m == pytest.approx(carton().board_m)
    assert true_box(truth, 0, np.eye(4), 0.003).thickness_m == 0.003


def test_a_box_is_found_again_and_numbered_as_the_plan_does() -> None:
    there = true_box(truth_of(carton(), x_m=0.6), 0, np.eye(4))
    elsewhere = true_box(truth_of(carton(), x_m=1.4), 0, np.eye(4))
    for shift in range(4):
        index, box = matched([elsewhere, renumbered(there, (4 - shift) % 4)], there)
        assert index == 1
        for board in there.boards:
            np.testing.assert_allclose(box.board(board.name).corners, board.corners)
    with pytest.raises(ValueError, match="no true box is within"):
        matched([elsewhere], there)


def test_the_wedge_under_a_box_that_leans_ends_where_its_base_does() -> None:
    truth = truth_of(carton())
    counted = 0
    for lean_deg, margin_m in ((0.0, None), (1.0, 0.15), (12.0, 0.0)):
        lean_rad = math.radians(lean_deg)
        leaning = msgspec.structs.replace(truth, up=(math.sin(lean_rad), 0.0, math.cos(lean_rad)))
        box = true_box(leaning, 0, np.eye(4))
        model = build_world(box, crease_class("ordinary"), PhysicsSettings()).model
        of_support = [k for k in range(model.ngeom) if model.geom_bodyid[k] == model.body("support").id]
        wedges = [k for k in of_support if model.geom_type[k] == mujoco.mjtGeom.mjGEOM_BOX]
        assert len(wedges) == (margin_m is not None)
        for k in wedges:
            local = (box.board("base").corners - box.world_from_box[:3, 3]) @ box.world_from_box[:3, :2]
            np.testing.assert_allclose(model.geom_size[k][:2], np.abs(local).max(axis=0) + margin_m)
            counted += 1
    assert counted == 2


def test_what_cannot_stand_is_refused() -> None:
    truth = truth_of(carton())
    with pytest.raises(ValueError, match="box 1 is not there"):
        true_box(truth, 1, np.eye(4))
    lying = np.eye(4)
    lying[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    tipped = msgspec.structs.replace(truth, up=(0.0, 1.0, 0.0))
    with pytest.raises(ValueError, match="leans by 90 degrees"):
        true_box(tipped, 0, np.eye(4))
    assert true_box(truth, 0, lying).up @ [0, -1, 0] == pytest.approx(1.0)
    baseless = msgspec.structs.replace(truth, parts=truth.parts[1:])
    with pytest.raises(ValueError, match="no base"):
        true_box(baseless, 0, np.eye(4))


def test_creases_are_data_with_sources_and_assumptions() -> None:
    creases = load_creases()
    assert list(creases.classes) == ["pre_broken", "ordinary", "stiff"]
    assert creases.sources
    assert creases.assumptions
    moments = [crease.moment_n_m_per_m for crease in creases.classes.values()]
    returns = [crease.return_deg for crease in creases.classes.values()]
    assert moments == sorted(moments)
    assert returns == sorted(returns)
    ordinary = crease_class("ordinary")
    assert ordinary.moment_n_m(0.5, 0.004) == pytest.approx(0.3)
    assert ordinary.moment_n_m(0.5, 0.002) == pytest.approx(0.15)
    turn_rad = math.radians(ordinary.return_deg)
    assert ordinary.stiffness_n_m_per_rad(0.5, 0.004) * turn_rad == pytest.approx(0.3)
    with pytest.raises(ValueError, match="must be one of pre_broken, ordinary, stiff"):
        crease_class("soft")


def test_settings_that_prove_nothing_are_refused() -> None:
    for wrong, words in (({"time_step_s": 0.002}, "0.001 or less"), ({"contact_time_s": 0.001}, "two time steps")):
        with pytest.raises(ValueError, match=words):
            PhysicsSettings(**wrong)


def test_a_modelled_box_turns_as_the_model_tells() -> None:
    rng, counted = np.random.default_rng(8), 0
    for _ in range(30):
        spec = random_spec(rng)
        if not spec.base_known:
            continue
        x, y, z = (float(c) for c in spec.rotation @ np.array([0.0, 0.0, 1.0]))
        box = modelled_box(random_object(spec, random_angles(spec, rng)), (x, y, z), np.eye(4))
        world = build_world(box, crease_class("ordinary"), PhysicsSettings())
        data, angles = mujoco.MjData(world.model), random_angles(spec, rng)
        for name, joint in world.box.joint_of.items():
            data.qpos[world.model.joint(joint).qposadr[0]] = angles[name]
        mujoco.mj_kinematics(world.model, data)
        wanted = panels(spec, angles)
        for board in box_as_it_stands(world, data, box).boards:
            np.testing.assert_allclose(board.corners, wanted[board.name], atol=1e-9)
            counted += 1
    assert counted > 100
