"""Rotations that files tell as quaternions x, y, z, w."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from boxwright.types.articulation import Quaternion


def rotation_of(quaternion: Quaternion) -> NDArray[np.float64]:
    """The rotation matrix (3, 3) of a quaternion of any length but 0."""
    x, y, z, w = np.array(quaternion) / math.hypot(*quaternion)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
