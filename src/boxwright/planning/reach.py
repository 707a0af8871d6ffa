"""What an arm can never do, wherever its joints stand: reach a box that is too far off, or wait inside itself."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.kinematics.transforms import Matrix, apply
from boxwright.robots import Robot
from boxwright.types import Object

Array = NDArray[np.float64]

ALONG = 1e-9
"""A step between joints whose sine to the joint's axis is below lies along it."""

GRID = 13
"""Points along each edge of a board: between them its distance is a millimetre less at the most."""


@dataclass(frozen=True)
class Reach:
    """A ball that the fingers never leave: about `shoulder_m` (3,) on joint 1's axis, the base's frame, metres."""

    shoulder_m: Array
    radius_m: float


def reach_of(robot: Robot) -> Reach:
    """The ball: the steps from joint to joint, end to end in line.

    A step along the axis of the joint that it starts from goes nowhere when that turns: it is added to the one before.
    """
    arm, gripper = robot.arm, robot.file.gripper
    tip_m = np.array([0.0, 0.0, max(gripper.body_size_m[2] + gripper.finger_size_m[2], gripper.tool_point_m[2])])
    steps = [*(place[:3, 3] for place in arm.parent_from_joint), apply(arm.last_link_from_flange, tip_m[None])[0]]
    for joint in reversed(range(1, len(arm.axes))):
        if _lies_along(steps[joint + 1], arm.axes[joint]):
            steps[joint] = steps[joint] + arm.parent_from_joint[joint][:3, :3] @ steps[joint + 1]
            steps[joint + 1] = np.zeros(3)
    axis, to_second = arm.axes[0], steps[1]
    up_the_axis = (to_second @ axis) * axis
    lengths_m = [float(np.linalg.norm(step)) for step in (to_second - up_the_axis, *steps[2:])]
    aside_m = float(np.hypot(gripper.finger_size_m[0] / 2.0, gripper.opening_m[1] / 2.0 + gripper.finger_size_m[1]))
    return Reach(apply(arm.parent_from_joint[0], up_the_axis[None])[0], sum(lengths_m) + aside_m)


def refuse_out_of_reach(robot: Robot, model_object: Object, base_from_input: Matrix) -> None:
    """Raises ValueError where no point of the box lies in the arm's reach: none of its flaps can be touched."""
    reach = reach_of(robot)
    boards = [np.array(part.corners) for part in model_object.parts if part.corners is not None]
    points = apply(base_from_input, np.concatenate([_spread(board) for board in boards]))
    away_m = float(np.linalg.norm(points - reach.shoulder_m, axis=1).min())
    if away_m <= reach.radius_m:
        return
    below_m = -float(points[:, 2].max())
    below = f" and {below_m:.2f} m below its base," if below_m > 0.0 else ""
    raise ValueError(
        f"camera pose: the box is {away_m:.2f} m from the arm's shoulder{below or ','} out of reach: {robot.name} with "
        f"its tool reaches {reach.radius_m:.2f} m at the most; base_from_input (metres) must put it before the arm"
    )


def refuse_ready(robot: Robot, name: str) -> None:
    """Raises ValueError where the arm in its ready pose stands inside itself: no camera pose mends that."""
    clearance = _core.Clearance(robot.arm, _core.World(), 0.0, robot.file.gripper.opening_m[0])
    nearest = clearance.nearest(robot.ready_rad)
    if nearest is not None and nearest[2] < 0.0:
        body, other, distance_m = nearest
        raise ValueError(
            f"{name}: ready_deg: the arm's {body} stands inside its own {other} by {-1000.0 * distance_m:.0f} mm; take "
            "another posture, or, where they are drawn too thick, name the pair in may_touch"
        )


def _lies_along(step: Array, axis: Array) -> bool:
    return bool(np.linalg.norm(np.cross(step, axis)) <= ALONG * max(float(np.linalg.norm(step)), 1.0))


def _spread(corners: Array) -> Array:
    """(GRID * GRID, 3) points of a board (4, 3), its corners among them."""
    shares = np.linspace(0.0, 1.0, GRID)
    u, v = (grid.ravel()[:, None] for grid in np.meshgrid(shares, shares))
    a, b, c, d = corners
    return np.asarray((1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d, np.float64)
