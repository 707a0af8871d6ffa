"""What must be right about a pose before anything is planned on it."""

from __future__ import annotations

import numpy as np

from boxwright.kinematics.transforms import Matrix, apply, from_pose
from boxwright.types import Model, Object

LEVEL_DEG = 5.0
"""A support that leans more against the robot's z than this is told of: the pose may be wrong."""

LIES_COS = 0.7
"""A box whose opening looks further off up lies: no plan reckons with how its flaps fall then."""

TOO_FAR_M = 3.0
"""No arm that this is for reaches farther."""

BELOW_FLOOR_M = 0.02
"""A box this far below the support it stands on is wrong."""


def refuse_poses(model: Model, model_object: Object, base_from_input: Matrix) -> None:
    """Raises ValueError where the box lies on a side or upside down, below its floor, or out of any arm's reach."""
    corners = np.concatenate([np.array(part.corners) for part in model_object.parts if part.corners is not None])
    corners_base = apply(base_from_input, corners)
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
    if corners_base[:, 2].max() < -TOO_FAR_M / 3.0:
        raise ValueError(
            f"camera pose: the box lies {-corners_base[:, 2].max():.2f} m below the robot's base, below the floor; "
            "base_from_input (metres) must put it near the base's height"
        )
    nearest_m = float(np.linalg.norm(corners_base, axis=1).min())
    if nearest_m > TOO_FAR_M:
        raise ValueError(
            f"camera pose: the box is {nearest_m:.2f} m from the robot's base, out of any reach; base_from_input "
            "(metres) must put it before the arm"
        )


def warnings_of(model: Model, base_from_input: Matrix) -> list[str]:
    """What a user should know of the pose beside the plan."""
    if model.support_plane is None:
        return ["the model has no support plane: the arm keeps clear of the box alone, not of what it stands on"]
    normal = base_from_input[:3, :3] @ np.array(model.support_plane.normal)
    lean_deg = float(np.degrees(np.arccos(np.clip(normal[2], -1.0, 1.0))))
    if lean_deg > LEVEL_DEG:
        return [f"the support leans {lean_deg:.1f} degrees against the robot's z; check the camera pose"]
    return []
