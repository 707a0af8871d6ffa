"""Rigid transforms as (4, 4) float64 matrices: `a_from_b` maps coordinates in b to coordinates in a (metres)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from boxwright.io.quaternions import rotation_of
from boxwright.types import Pose

Matrix = NDArray[np.float64]


def rigid(rotation: Matrix, translation: Sequence[float] | Matrix) -> Matrix:
    """The transform with that rotation (3, 3) and translation (3,)."""
    transform = np.eye(4)
    transform[:3, :3] = rotation
    transform[:3, 3] = translation
    return transform


def inverse(a_from_b: Matrix) -> Matrix:
    """b_from_a of a rigid transform."""
    rotation = a_from_b[:3, :3].T
    return rigid(rotation, -rotation @ a_from_b[:3, 3])


def apply(a_from_b: Matrix, points_b: Matrix) -> Matrix:
    """Points (N, 3) in b, told in a."""
    return points_b @ a_from_b[:3, :3].T + a_from_b[:3, 3]


def from_pose(pose: Pose) -> Matrix:
    """The transform of a pose: a_from_b for a pose of b in a; quaternion x, y, z, w."""
    return rigid(rotation_of(pose.orientation), pose.position)


def turn_about_line(origin: Sequence[float], axis: Sequence[float], angle_rad: float) -> Matrix:
    """The motion that turns by the right hand about a line through `origin` (m) along `axis` (Rodrigues, eq. 34)."""
    unit = np.array(axis) / math.hypot(*axis)
    cross = np.array([[0.0, -unit[2], unit[1]], [unit[2], 0.0, -unit[0]], [-unit[1], unit[0], 0.0]])
    rotation = np.eye(3) + math.sin(angle_rad) * cross + (1.0 - math.cos(angle_rad)) * (cross @ cross)
    point = np.array(origin)
    return rigid(rotation, point - rotation @ point)


def roll_pitch_yaw(rotation: Matrix) -> tuple[float, float, float]:
    """URDF's fixed-axis angles (rad): rotation = Rz(yaw) Ry(pitch) Rx(roll).

    Each angle is read after the one before is undone, so that nothing is lost near pitch = 90 degrees.
    """
    yaw = math.atan2(rotation[1, 0], rotation[0, 0])
    sin_yaw, cos_yaw = math.sin(yaw), math.cos(yaw)
    pitch = math.atan2(-rotation[2, 0], cos_yaw * rotation[0, 0] + sin_yaw * rotation[1, 0])
    roll = math.atan2(
        sin_yaw * rotation[0, 2] - cos_yaw * rotation[1, 2], cos_yaw * rotation[1, 1] - sin_yaw * rotation[0, 1]
    )
    return roll, pitch, yaw


def quaternion_wxyz(a_from_b: Matrix) -> tuple[float, float, float, float]:
    """The unit quaternion w, x, y, z of a transform's rotation, w not negative.

    Each of the four is twice its square root of the diagonal's sums; the largest is taken, so that nothing is lost near
    half a turn (S. W. Shepperd, J. Guidance and Control 1 (1978) 223).
    """
    r = a_from_b[:3, :3]
    squares = np.array(
        [
            1.0 + r[0, 0] + r[1, 1] + r[2, 2],
            1.0 + r[0, 0] - r[1, 1] - r[2, 2],
            1.0 - r[0, 0] + r[1, 1] - r[2, 2],
            1.0 - r[0, 0] - r[1, 1] + r[2, 2],
        ]
    )
    x, y, z = r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]
    xy, xz, yz = r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[1, 2] + r[2, 1]
    rows = np.array([[squares[0], x, y, z], [x, squares[1], xy, xz], [y, xy, squares[2], yz], [z, xz, yz, squares[3]]])
    row = rows[int(np.argmax(squares))]
    unit = row / np.linalg.norm(row) * (1.0 if row[0] >= 0.0 else -1.0)
    return float(unit[0]), float(unit[1]), float(unit[2]), float(unit[3])
