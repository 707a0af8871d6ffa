"""Where to put the robot: a place from which a box can be closed, and the smallest move that lets one more flap be."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any

import msgspec
import numpy as np

from boxwright.kinematics.transforms import Matrix, from_pose, inverse, rigid, turn_about_line
from boxwright.planning.asking import ask, ask_bearable
from boxwright.planning.checks import refuse_poses
from boxwright.planning.measured import measured_box
from boxwright.planning.reach import refuse_ready
from boxwright.robots import load_robot
from boxwright.types import Model, Plan, Pose, SmallestMove

DISTANCES_M = (0.52, 0.60, 0.45, 0.68)
"""From the J1 axis to the middle of the box."""

BELOW_M = (0.15, 0.0, 0.3)
"""The box's support lies this far below the robot's base."""

BEARINGS = 12
"""Directions from which the robot looks at the box."""

PATIENCE = 24
"""The search ends when so many places in a row, two circles of them, were no better than the best before."""

LOOKED_AT_AGAIN = 3
"""Places at which quick searches close most, and which the whole planner then chooses from."""

STEPS_M = (0.05, 0.10, 0.15, 0.20, 0.30)
TURNS_DEG = (15.0, -15.0, 30.0, -30.0)
TURN_M_PER_RAD = 0.5
"""A turn of the base by a radian counts as a move by this much."""


def place_robot(
    model: Model, robot: str | PathLike[str], *, object_index: int = 0, settings: Mapping[str, Any] | None = None
) -> Pose:
    """base_from_input of the first place, of a fixed list, from which most flaps can be closed; all, where one does.

    Quick searches go through the list until all flaps are closed but those that the box does not stand being pushed
    (eq. 97), or until two circles of places bring nothing more; then the whole planner chooses among the best.

    Raises ValueError where the model has no such object, where it has no pose, or where no place closes any flap.
    """
    if not 0 <= object_index < len(model.objects):
        had = f"it has {len(model.objects)}, counted from 0" if model.objects else "no box was found in it"
        raise ValueError(f"object {object_index} is not in the model; {had}")
    if model.objects[object_index].pose is None:
        raise ValueError(f"object {object_index} has no pose: too little of it was seen to put a robot before it")
    refuse_ready(load_robot(robot), str(robot))
    tried, closes_all = _tried_quickly(model, robot, object_index, settings)
    if not tried:
        raise ValueError(f"object {object_index}: no place of the list suits robot {str(robot)!r}; give --camera-pose")
    # Sorting keeps the list's order among equals.
    best = sorted(tried, key=lambda place: -place[0])[:LOOKED_AT_AGAIN]
    if closes_all:
        return _pose(best[0][1])
    counts = [_closed_and_left(model, robot, object_index, place, settings)[0] or 0 for _, place in best]
    return _pose(best[counts.index(max(counts))][1])


def _tried_quickly(
    model: Model, robot: str | PathLike[str], index: int, settings: Mapping[str, Any] | None
) -> tuple[list[tuple[int, Matrix]], bool]:
    """How many flaps quick searches close from each place that they came to; does the last close all that can be?"""
    bearable = ask_bearable(measured_box(model, index, np.eye(4)), settings)
    hopeless = sum(not can for can in bearable.values())
    tried: list[tuple[int, Matrix]] = []
    most, since = -1, 0
    for base_from_input in _places(model, index):
        closed, left = _closed_and_left(model, robot, index, base_from_input, settings, quick=True)
        since += 1
        if closed is not None:
            tried.append((closed, base_from_input))
            if closed > most:
                most, since = closed, 0
            if left <= hopeless:
                return tried, True
        if tried and since >= PATIENCE:
            break
    return tried, False


def with_moves(plan: Plan, model: Model, robot: str | PathLike[str], settings: Mapping[str, Any] | None = None) -> Plan:
    """The plan, with the smallest move of the base, of a fixed list, that lets each flap be closed that it leaves open.

    A flap is tried by itself, the others where the plan leaves them.
    """
    stuck = ("unreachable", "joint_limit", "blocked")
    outcomes = {
        name: msgspec.structs.replace(flap, move=_smallest_move(plan, name, model, robot, settings))
        if flap.status in stuck
        else flap
        for name, flap in plan.flaps.items()
    }
    return msgspec.structs.replace(plan, flaps=outcomes)


def _smallest_move(
    plan: Plan, flap: str, model: Model, robot: str | PathLike[str], settings: Mapping[str, Any] | None
) -> SmallestMove | None:
    base_from_input = np.array(plan.base_from_input)
    for move in _moves():
        moved = inverse(_transform(move)) @ base_from_input
        try:
            refuse_poses(model, model.objects[plan.object], moved)
            box = measured_box(model, plan.object, moved)
            answer = ask(robot, box, settings, only=(flap,), closed=plan.order)
        except ValueError:
            # The arm's base would stand inside something there.
            continue
        if flap in answer["order"]:
            return move
    return None


def _moves() -> list[SmallestMove]:
    """Moves along the axes and between them, and turns, the smallest first."""
    found = []
    for step_m in STEPS_M:
        for x, y in itertools.product((-1, 0, 1), repeat=2):
            length = float(np.hypot(x, y))
            if length:
                found.append(_move(step_m * x / length, step_m * y / length))
        found += [_move(z_m=sign * step_m) for sign in (1.0, -1.0)]
    found += [_move(yaw_rad=float(np.radians(turn))) for turn in TURNS_DEG]
    return sorted(
        found, key=lambda m: round(float(np.hypot(np.hypot(m.x_m, m.y_m), m.z_m)) + TURN_M_PER_RAD * abs(m.yaw_rad), 9)
    )


def _move(x_m: float = 0.0, y_m: float = 0.0, z_m: float = 0.0, yaw_rad: float = 0.0) -> SmallestMove:
    return SmallestMove(x_m=float(x_m), y_m=float(y_m), z_m=z_m, yaw_rad=yaw_rad)


def _transform(move: SmallestMove) -> Matrix:
    """base_from_moved_base."""
    turned = turn_about_line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), move.yaw_rad)
    return rigid(turned[:3, :3], (move.x_m, move.y_m, move.z_m))


def _closed_and_left(
    model: Model,
    robot: str | PathLike[str],
    index: int,
    base_from_input: Matrix,
    settings: Mapping[str, Any] | None,
    *,
    quick: bool = False,
) -> tuple[int | None, int]:
    """Flaps that are closed from a place and open ones that are not; None where the arm cannot stand there."""
    box = measured_box(model, index, base_from_input)
    try:
        answer = ask(robot, box, settings, quick=quick)
    except ValueError:
        # Robot, model and object were looked at before: the arm would stand inside something here.
        return None, 0
    unknown = ("planned", "already_closed", "absent", "hidden")
    return len(answer["order"]), sum(flap["status"] not in unknown for flap in answer["flaps"])


def _places(model: Model, index: int) -> Iterator[Matrix]:
    """base_from_input of each place: the box's base `DISTANCES_M` ahead of the arm, from all around."""
    pose = model.objects[index].pose
    assert pose is not None
    up = np.array(model.up)
    box = from_pose(pose)
    x = box[:3, 0] - (box[:3, 0] @ up) * up
    x /= np.linalg.norm(x)
    level_from_input = inverse(rigid(np.column_stack([x, np.cross(up, x), up]), box[:3, 3]))
    for below_m, distance_m, bearing in itertools.product(BELOW_M, DISTANCES_M, range(BEARINGS)):
        turn = turn_about_line((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 2.0 * np.pi * bearing / BEARINGS)
        yield rigid(turn[:3, :3], (distance_m, 0.0, -below_m)) @ level_from_input


def _pose(base_from_input: Matrix) -> Pose:
    from boxwright.planning.quaternions import quaternion

    position = tuple(float(value) for value in base_from_input[:3, 3])
    return Pose(position=(position[0], position[1], position[2]), orientation=quaternion(base_from_input[:3, :3]))
