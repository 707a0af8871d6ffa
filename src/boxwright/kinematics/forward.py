"""Forward kinematics: where every panel and hinge of an object is at given joint positions.

A joint's origin and axis are told as measured, in the input's frame. A part moves by the motions of all hinges between
it and the fixed parts, the nearest to it applied first: M(part) = M(parent) turn(origin, axis, position - measured)
(eq. 35 of docs/maths.md).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from boxwright.kinematics.transforms import Matrix, apply, turn_about_line
from boxwright.types import Joint, Object


def configuration(model_object: Object) -> dict[str, float]:
    """The measured position (rad) of every joint by its name; 0 is closed (docs/formats.md)."""
    return {joint.name: joint.position for joint in model_object.joints}


def part_motions(model_object: Object, positions_rad: Mapping[str, float]) -> dict[str, Matrix]:
    """The rigid motion (4, 4), input's frame, that takes each part from where it was measured to these positions.

    Joints that `positions_rad` leaves out stay as measured. Raises ValueError for a joint that is not the object's.
    """
    measured_rad = configuration(model_object)
    unknown = sorted(set(positions_rad) - set(measured_rad))
    if unknown:
        raise ValueError(f"positions: {unknown[0]!r} is no joint of this object; its joints: {sorted(measured_rad)}")
    joint_of = {joint.child: joint for joint in model_object.joints}
    return {part.name: _motion(part.name, joint_of, positions_rad) for part in model_object.parts}


def part_corners(model_object: Object, positions_rad: Mapping[str, float]) -> dict[str, Matrix]:
    """The corners (4, 3), metres, input's frame, of each part that has them, at these joint positions (rad).

    At the measured positions they are the parts' own. Joints left out stay as measured; ValueError for unknown joints.
    """
    motions = part_motions(model_object, positions_rad)
    return {
        part.name: apply(motions[part.name], np.array(part.corners))
        for part in model_object.parts
        if part.corners is not None
    }


def hinge_lines(model_object: Object, positions_rad: Mapping[str, float]) -> dict[str, tuple[Matrix, Matrix]]:
    """Origin (3,) in metres and unit axis (3,) of each joint, input's frame, at these joint positions (rad)."""
    motions = part_motions(model_object, positions_rad)
    return {
        joint.name: (
            apply(motions[joint.parent], np.array(joint.origin)),
            motions[joint.parent][:3, :3] @ np.array(joint.axis),
        )
        for joint in model_object.joints
    }


def _motion(part_name: str, joint_of: Mapping[str, Joint], positions_rad: Mapping[str, float]) -> Matrix:
    if part_name not in joint_of:
        return np.eye(4)
    joint = joint_of[part_name]
    angle_rad = positions_rad.get(joint.name, joint.position) - joint.position
    return _motion(joint.parent, joint_of, positions_rad) @ turn_about_line(joint.origin, joint.axis, angle_rad)
