"""Rigid motions as 4x4 matrices; `a_from_b` maps coordinates in b to coordinates in a. Metres and radians."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def translation(offset_m: ArrayLike) -> Array:
    pose = np.eye(4)
    pose[:3, 3] = offset_m
    return pose


def rotation(axis: ArrayLike, angle_rad: float) -> Array:
    """About an axis through the origin, by the right-hand rule (Rodrigues)."""
    x, y, z = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    pose = np.eye(4)
    pose[:3, :3] += np.sin(angle_rad) * skew + (1 - np.cos(angle_rad)) * skew @ skew
    return pose


def standing(x_m: float, y_m: float, yaw_rad: float, z_m: float = 0.0) -> Array:
    """Turned about the vertical and moved."""
    return translation([x_m, y_m, z_m]) @ rotation([0, 0, 1], yaw_rad)


def apply(a_from_b: Array, points_b: Array) -> Array:
    """Points (..., 3) of frame b in frame a."""
    return points_b @ a_from_b[:3, :3].T + a_from_b[:3, 3]


def inverse(a_from_b: Array) -> Array:
    pose = np.eye(4)
    pose[:3, :3] = a_from_b[:3, :3].T
    pose[:3, 3] = -a_from_b[:3, :3].T @ a_from_b[:3, 3]
    return pose
