"""What every plan keeps, held every millisecond against coal and against the robot's file."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec
import numpy as np
import pytest
from closing.problems import Problem, draw_problem

from boxwright.io.plans import load_plan, save_plan
from boxwright.planning import plan_closing
from boxwright.types import Plan
from support.arm_geometry import limits
from support.dense_check import Clearances, dense
from support.repository import PACKAGE

ROBOT = "viper_s850"
ROBOT_FILE = PACKAGE / "robots" / "data" / f"{ROBOT}.toml"
FEW = (1, 3, 5, 8, 9, 16, 18, 25, 29)
"""Cartons, cake boxes and pizza boxes of the set, small and large."""
MANY = os.environ.get("BOXWRIGHT_PLAN_LAWS")
"""FIRST,LAST: those problems of the set instead, at two seconds each."""
NUMBERS = tuple(range(*(int(number) for number in MANY.split(",")))) if MANY else FEW

CLEARANCE_M = 0.005
ROUNDING = 1e-6


@pytest.fixture(scope="module")
def plans() -> list[tuple[Problem, Plan]]:
    problems = [draw_problem(number) for number in NUMBERS]
    return [(problem, plan_closing(problem.model, ROBOT, np.eye(4))) for problem in problems]


def test_speeds_accelerations_and_limits_hold_every_millisecond(plans: list[tuple[Problem, Plan]]) -> None:
    bounds = limits(ROBOT_FILE)
    checked = 0
    for problem, plan in plans:
        for segment in plan.segments:
            moves = dense(segment)
            name = f"problem {problem.number}: {segment.kind} {segment.flap}"
            assert (moves.positions >= bounds["positions"][:, 0] - ROUNDING).all(), name
            assert (moves.positions <= bounds["positions"][:, 1] + ROUNDING).all(), name
            assert (np.abs(moves.velocities) <= bounds["speeds"] + ROUNDING).all(), name
            assert (np.abs(moves.accelerations) <= bounds["accelerations"] + ROUNDING).all(), name
            assert (np.array([segment.velocities[0], segment.velocities[-1]]) == 0.0).all(), f"{name}: not at rest"
            checked += len(moves.positions)
    assert checked > 100_000


def test_clearances_hold_every_millisecond(plans: list[tuple[Problem, Plan]]) -> None:
    segments = fingers = 0
    for problem, plan in plans:
        for what, least_m in Clearances(problem.model, ROBOT_FILE).of_plan(plan):
            if what == "finger":
                fingers += 1
                assert least_m >= -ROUNDING, f"problem {problem.number}: a finger is {-1e3 * least_m:.3f} mm in a flap"
                assert least_m < 0.002, f"problem {problem.number}: a finger never touches its flap"
            else:
                segments += 1
                assert least_m >= CLEARANCE_M - ROUNDING, f"problem {problem.number}: {what}: {1e3 * least_m:.2f} mm"
    assert fingers > 15
    assert segments > 60


def test_each_piece_begins_where_the_one_before_ended(plans: list[tuple[Problem, Plan]]) -> None:
    joints = 0
    for problem, plan in plans:
        for before, after in zip(plan.segments, plan.segments[1:], strict=False):
            assert before.positions[-1] == after.positions[0], f"problem {problem.number}: {after.kind} {after.flap}"
            assert before.times[-1] == after.times[0]
            joints += 1
    assert joints > 60


def test_the_arm_begins_and_ends_ready_and_closes_in_order(plans: list[tuple[Problem, Plan]]) -> None:
    pushes = forks = 0
    for problem, plan in plans:
        # Flaps that overlap those across from them lie on these, not flat.
        most_rad = np.radians(20.0 if problem.variant == "overlap" else 3.0)
        pushed = [segment for segment in plan.segments if segment.kind == "push"]
        last = {segment.flap: segment for segment in pushed}
        assert tuple(last) == plan.order
        assert plan.segments[0].positions[0] == plan.segments[-1].positions[-1]
        for number, segment in enumerate(pushed):
            assert segment.hinge_angle_rad is not None
            angles_rad = np.array(segment.hinge_angle_rad)
            lowest = int(angles_rad.argmin())
            is_fork = segment.gripper_opening_m > 0.0
            assert (np.diff(angles_rad[: lowest + 1]) < 1e-9).all(), "a flap is pushed inward only"
            # Fingers astride it go back with it as its crease gives back (12 degrees, and what it turns between them).
            assert (np.diff(angles_rad[lowest:]) > -1e-9).all()
            assert angles_rad[-1] - angles_rad[lowest] < (np.radians(14.0) if is_fork else 1e-9)
            if segment is last[segment.flap]:
                assert segment.gripper_opening_m == 0.0
                assert segment.hinge_angle_rad[-1] > -np.radians(13.0) - ROUNDING
                # One that has no room at closed is let go where it comes to rest closed.
                rest_rad = plan.flaps[segment.flap].rest_rad
                assert rest_rad is not None
                assert segment.hinge_angle_rad[-1] < most_rad or rest_rad < np.radians(12.5)
                continue
            # Turned in stages, it springs back from each, with open fingers still astride it; a couple that is the last
            # of them leaves room for a push.
            after = pushed[number + 1].hinge_angle_rad
            assert segment.flap == pushed[number + 1].flap
            assert after is not None
            sprung_rad = after[0] - angles_rad[-1]
            assert abs(sprung_rad) < 1e-9 if is_fork else 0.0 < sprung_rad < np.radians(30.0)
            assert not is_fork or segment.gripper_opening_m > (problem.box.thickness or 0.0)
            if is_fork and pushed[number + 1] is last[segment.flap]:
                assert angles_rad[lowest] < np.radians(62.0) + ROUNDING
            forks += is_fork
        pushes += len(pushed)
    assert pushes > 15
    assert forks >= 3


def test_the_gripper_opens_and_closes_in_the_ready_pose(plans: list[tuple[Problem, Plan]]) -> None:
    changes = 0
    for problem, plan in plans:
        for before, after in zip(plan.segments, plan.segments[1:], strict=False):
            if before.gripper_opening_m != after.gripper_opening_m:
                assert after.positions[0] == plan.segments[0].positions[0], f"problem {problem.number}"
                changes += 1
    assert changes >= 3


def test_the_same_input_gives_the_same_bits(plans: list[tuple[Problem, Plan]], tmp_path: Path) -> None:
    compared = 0
    for problem, plan in plans[:4]:
        again = plan_closing(problem.model, ROBOT, np.eye(4))
        assert _timeless(again) == _timeless(plan)
        save_plan(plan, tmp_path / "plan.json")
        assert load_plan(tmp_path / "plan.json") == plan
        compared += len(plan.segments)
    assert compared > 20


def test_moving_robot_and_box_together_changes_nothing_but_rounding() -> None:
    """The base frame is the robot's: the input's frame may be anywhere."""
    problem = draw_problem(8)
    turn = np.eye(4)
    turn[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    turn[:3, 3] = (0.3, -0.2, 0.1)
    moved = _moved(problem, turn)
    plain = plan_closing(problem.model, ROBOT, np.eye(4))
    other = plan_closing(moved, ROBOT, np.linalg.inv(turn))
    assert other.order == plain.order
    assert other.segments[-1].times[-1] == pytest.approx(plain.segments[-1].times[-1], rel=0.2)


def _moved(problem: Problem, input_from_base: np.ndarray):
    def point(values: tuple[float, ...]) -> tuple[float, ...]:
        return tuple((input_from_base[:3, :3] @ values + input_from_base[:3, 3]).tolist())

    def vector(values: tuple[float, ...]) -> tuple[float, ...]:
        return tuple((input_from_base[:3, :3] @ values).tolist())

    box = problem.box
    parts = tuple(
        msgspec.structs.replace(part, corners=part.corners and tuple(map(point, part.corners))) for part in box.parts
    )
    joints = tuple(
        msgspec.structs.replace(joint, origin=point(joint.origin), axis=vector(joint.axis)) for joint in box.joints
    )
    plane = problem.model.support_plane
    assert plane is not None
    lifted = msgspec.structs.replace(plane, distance=plane.distance + input_from_base[2, 3])
    moved = msgspec.structs.replace(box, parts=parts, joints=joints, pose=None)
    return msgspec.structs.replace(problem.model, objects=(moved,), support_plane=lifted)


def _timeless(plan: Plan) -> Plan:
    flaps = {name: msgspec.structs.replace(flap, seconds=0.0) for name, flap in plan.flaps.items()}
    return msgspec.structs.replace(plan, seconds=0.0, flaps=flaps)
