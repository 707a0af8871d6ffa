"""What must be right about a pose before anything is planned on it."""

from __future__ import annotations

import numpy as np

from boxwright.kinematics.transforms import Matrix, apply, from_pose
from boxwright.types import Model, Object
from boxwright.types.posed import FARTHEST_M

LEVEL_DEG = 1.5
"""A support that leans more against the robot's z is told of: the pose may be wrong.

Physics levels what leans less. The support of a simulated frame is known to 0.6 degrees in 99 of 100, to 0.04 in half.
"""

CLEARANCE_MM = 5.0
"""What the arm keeps clear (docs/planning.md), for the warning alone."""

BELOW_FLOOR_M = 0.8
"""A box that stands further below the robot's base is told of: no table that an arm is bolted to is higher."""

LIES_COS = 0.7
"""A box whose opening looks further off up lies: no plan reckons with how its flaps fall then."""


def refuse_far_base(base_from_input: Matrix) -> None:
    """Raises ValueError where the pose is no finite one, or so far off that it was not told in metres."""
    position = base_from_input[:3, 3]
    if not np.isfinite(base_from_input).all() or np.abs(position).max() > FARTHEST_M:
        told = ", ".join(f"{value:.4g}" for value in position)
        raise ValueError(
            f"camera pose: position is ({told}); base_from_input is in metres, none more than {FARTHEST_M:.0f}"
        )


def refuse_poses(model: Model, model_object: Object, base_from_input: Matrix) -> None:
    """Raises ValueError where the box lies on a side, or where the pose turns it upside down."""
    if model_object.pose is not None:
        opens = float(from_pose(model_object.pose)[:3, 2] @ np.array(model.up))
        if opens < LIES_COS:
            raise ValueError(
                f"object ({model_object.template}) lies on a side: its opening looks "
                f"{np.degrees(np.arccos(opens)):.0f} degrees off up; stand it up first"
            )
    up = base_from_input[:3, :3] @ np.array(model.up)
    if up[2] < 0.0:
        raise ValueError(
            f"camera pose: the box's up is ({up[0]:.2f}, {up[1]:.2f}, {up[2]:.2f}) in the robot's base frame, below "
            "the floor; base_from_input must turn it to +z"
        )


def warnings_of(model: Model, model_object: Object, base_from_input: Matrix) -> list[str]:
    """What a user should know of the pose beside the plan."""
    lines = (
        _without_support(model),
        _leaning(model, model_object, base_from_input),
        _low(model_object, base_from_input),
    )
    return [line for line in lines if line is not None]


def _without_support(model: Model) -> str | None:
    if model.support_plane is not None:
        return None
    return "the model has no support plane: the arm keeps clear of the box alone, not of what it stands on"


def _leaning(model: Model, model_object: Object, base_from_input: Matrix) -> str | None:
    if model.support_plane is None:
        return None
    normal = base_from_input[:3, :3] @ np.array(model.support_plane.normal)
    lean_rad = float(np.arccos(np.clip(normal[2], -1.0, 1.0)))
    if np.degrees(lean_rad) <= LEVEL_DEG:
        return None
    middle = _corners(model_object, base_from_input).mean(axis=0)
    away_m = float(np.hypot(middle[0], middle[1]))
    off_mm = 1000.0 * away_m * np.tan(lean_rad)
    return (
        f"the support leans {np.degrees(lean_rad):.1f} degrees against the robot's z: if the camera pose is off by "
        f"that, heights are off by up to {off_mm:.0f} mm over the {away_m:.2f} m to the box, "
        f"and the arm keeps {CLEARANCE_MM:.0f} mm clear; check the camera pose"
    )


def _low(model_object: Object, base_from_input: Matrix) -> str | None:
    below_m = -float(_corners(model_object, base_from_input)[:, 2].min())
    if below_m <= BELOW_FLOOR_M:
        return None
    return (
        f"the box stands {below_m:.2f} m below the robot's base, below the floor unless the robot stands on something "
        "so high; check the camera pose"
    )


def _corners(model_object: Object, base_from_input: Matrix) -> Matrix:
    """(N, 3) of all boards, the base's frame."""
    corners = np.concatenate([np.array(part.corners) for part in model_object.parts if part.corners is not None])
    return apply(base_from_input, corners)
