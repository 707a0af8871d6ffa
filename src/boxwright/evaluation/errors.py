"""How far a right flap's hinge and angle, and a box's dimensions, are from the truth."""

from __future__ import annotations

import math

import numpy as np

from boxwright.evaluation.scores import FlapError
from boxwright.types import Joint, Object, TrueBox, TruePart


def flap_error(joint: Joint, true_flap: TruePart, flap_name: str) -> FlapError:
    """Errors of a predicted hinge against a true flap, whose hinge runs from its first corner to its second.

    Raises ValueError when the truth does not tell the flap's angle.
    """
    if true_flap.angle_deg is None:
        raise ValueError(f"truth: parts: {true_flap.name}: angle_deg is null; a flap has an angle")
    start, end = np.array(true_flap.corners[0]), np.array(true_flap.corners[1])
    true_axis = (end - start) / np.linalg.norm(end - start)
    axis = np.array(joint.axis) / math.hypot(*joint.axis)
    to_midpoint = (start + end) / 2.0 - np.array(joint.origin)
    return FlapError(
        flap=flap_name,
        hinge_angle_rad=math.atan2(float(np.linalg.norm(np.cross(axis, true_axis))), float(axis @ true_axis)),
        hinge_distance_m=float(np.linalg.norm(to_midpoint - (to_midpoint @ axis) * axis)),
        flap_angle_rad=abs(joint.position - math.radians(true_flap.angle_deg)),
    )


def dimension_errors(model_object: Object, true_box: TrueBox, rotation: int) -> tuple[float, float, float] | None:
    """|difference| of length, width and height in metres, true names; None where object or truth does not tell them."""
    if model_object.dimensions is None or true_box.dims is None:
        return None
    length, width, height = model_object.dimensions
    if rotation % 2:
        length, width = width, length
    true_length, true_width, true_height = true_box.dims
    return abs(length - true_length), abs(width - true_width), abs(height - true_height)
