"""Rotations as unit quaternions x, y, z, w."""

from __future__ import annotations

import numpy as np

from boxwright.kinematics.transforms import Matrix
from boxwright.types.articulation import Quaternion


def quaternion(rotation: Matrix) -> Quaternion:
    """The quaternion of a rotation (3, 3), w not negative: the eigenvector of Bar-Itzhack's matrix (2000)."""
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rotation
    matrix = (
        np.array(
            [
                [xx - yy - zz, yx + xy, zx + xz, zy - yz],
                [yx + xy, yy - xx - zz, zy + yz, xz - zx],
                [zx + xz, zy + yz, zz - xx - yy, yx - xy],
                [zy - yz, xz - zx, yx - xy, xx + yy + zz],
            ]
        )
        / 3.0
    )
    x, y, z, w = (float(value) for value in np.linalg.eigh(matrix)[1][:, -1])
    sign = -1.0 if w < 0.0 else 1.0
    return sign * x, sign * y, sign * z, sign * w
