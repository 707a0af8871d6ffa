"""Frames of links: one for each panel that has corners, hung as a tree on one root.

A panel's frame has its origin in the middle of the panel's first edge, x along that edge, y in the panel towards the
other two corners, z = x cross y. A link that turns has its origin in its joint's origin and x along the joint's axis, y
and z as above. The root's frame is the object's frame where its pose is known. Every other link has its panel's frame.
"""

from __future__ import annotations

import numpy as np

from boxwright.kinematics.transforms import Matrix, from_pose, inverse, rigid, turn_about_line
from boxwright.types import Joint, Object

SHORTEST_M = 1e-6
"""Edges and widths below this (m) are no panel."""

ROOT_PART = "base"
"""The part that carries the others, wherever the object has it."""


def corners_of(model_object: Object) -> dict[str, Matrix]:
    """Corners (4, 3), metres, input's frame, of each part that has them, in the order of the parts."""
    return {part.name: np.array(part.corners) for part in model_object.parts if part.corners is not None}


def root_part(model_object: Object, root: str | None) -> str:
    """The part to hang all others on: `root` where it is named, else the base, else the first fixed part with corners.

    Raises ValueError when there is none, or when the one that is named has no corners or turns on a joint.
    """
    turning = {joint.child for joint in model_object.joints}
    fixed = [name for name in corners_of(model_object) if name not in turning]
    if not fixed:
        raise ValueError(f"object {model_object.template!r} has no fixed part with corners; a root must be one")
    if root is None:
        return ROOT_PART if ROOT_PART in fixed else fixed[0]
    if root not in fixed:
        raise ValueError(f"root is {root!r}; it must be a fixed part with corners: {', '.join(fixed)}")
    return root


def panel_frame(name: str, corners: Matrix) -> Matrix:
    """input_from_panel of a panel's corners (4, 3). Raises ValueError when the panel has no length or no width."""
    along = _unit(name, corners[1] - corners[0])
    return _frame(name, (corners[0] + corners[1]) / 2.0, along, corners)


def link_frames(model_object: Object, root: str) -> dict[str, Matrix]:
    """input_from_link of every panel, as measured. Raises ValueError when a panel has no length or no width."""
    joint_of = {joint.child: joint for joint in model_object.joints}
    frames = {}
    for name, corners in corners_of(model_object).items():
        if name in joint_of:
            joint = joint_of[name]
            frames[name] = _frame(name, np.array(joint.origin), _unit(name, np.array(joint.axis)), corners)
        elif name == root and model_object.pose is not None:
            frames[name] = from_pose(model_object.pose)
        else:
            frames[name] = panel_frame(name, corners)
    return frames


def parent_from_joint(joint: Joint, frames: dict[str, Matrix]) -> Matrix:
    """Where the child's link is in its parent's when the joint is at 0, that is closed (eq. 36); x is the axis."""
    closed_from_measured = turn_about_line(joint.origin, joint.axis, -joint.position)
    return inverse(frames[joint.parent]) @ closed_from_measured @ frames[joint.child]


def _frame(name: str, origin: Matrix, along: Matrix, corners: Matrix) -> Matrix:
    outward = corners.mean(axis=0) - origin
    across = _unit(name, outward - (outward @ along) * along)
    return rigid(np.column_stack([along, across, np.cross(along, across)]), origin)


def _unit(name: str, vector: Matrix) -> Matrix:
    length_m = float(np.linalg.norm(vector))
    if length_m < SHORTEST_M:
        raise ValueError(f"part {name!r} has corners on one line or in one point; a panel has length and width")
    return vector / length_m
