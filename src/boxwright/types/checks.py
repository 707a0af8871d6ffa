"""Value checks that the types share; each raises ValueError with one line that says what would have been right."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

UNIT_TOLERANCE = 1e-6
"""How far the length of a unit vector or quaternion may be from 1: above float32 rounding, below any real mistake."""

SHORTEST_DIRECTION, LONGEST_DIRECTION = 1e-6, 1e6
"""Vectors of other lengths are mistakes, not directions: 0 tells none, and squares must neither vanish nor overflow."""

NAME_PATTERN = r"^[A-Za-z][A-Za-z0-9_]*$"
"""Names of templates, parts and joints: safe as they stand in URDF, MJCF, ROS and file names."""


def require_finite(name: str, values: Iterable[float]) -> None:
    """Refuse NaN and infinities."""
    for value in values:
        if not math.isfinite(value):
            raise ValueError(f"{name} holds {value}; it must be finite")


def require_unit(name: str, values: tuple[float, ...]) -> None:
    """Refuse a vector or quaternion whose length is not 1 within UNIT_TOLERANCE."""
    require_finite(name, values)
    length = math.hypot(*values)
    if abs(length - 1.0) > UNIT_TOLERANCE:
        raise ValueError(f"{name} has length {length:.9g}; it must be a unit vector (length 1)")


def require_direction(name: str, values: Sequence[float]) -> None:
    """Refuse what is no direction in space: three finite numbers; any length will do, within reason."""
    if len(values) != 3:
        raise ValueError(f"{name} has {len(values)} values; it must be x, y, z")
    require_finite(name, values)
    length = math.hypot(*values)
    if not SHORTEST_DIRECTION <= length <= LONGEST_DIRECTION:
        raise ValueError(
            f"{name} has length {length:g}; a direction is told by a vector that is neither next to nothing nor huge"
        )


def require_positive(name: str, values: Iterable[float]) -> None:
    """Refuse anything that is not finite and above 0."""
    for value in values:
        if math.isnan(value):
            raise ValueError(f"{name} holds nan, which is no number; it must be above 0")
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} holds {value}; it must be above 0")


def require_not_negative(name: str, values: Iterable[float]) -> None:
    """Refuse anything that is not finite and at least 0."""
    for value in values:
        if not (math.isfinite(value) and value >= 0.0):
            raise ValueError(f"{name} holds {value}; it must be 0 or more")


def require_probability(name: str, value: float | None) -> None:
    """Refuse a number outside 0..1; None (not known) passes."""
    if value is not None and not 0.0 <= value <= 1.0:
        raise ValueError(f"{name} is {value}; a probability lies in 0..1")


def require_rigid(name: str, matrix: NDArray[np.float64], tolerance: float = UNIT_TOLERANCE) -> None:
    """Refuse what is no rigid motion (4, 4) within a tolerance."""
    if matrix.shape != (4, 4):
        raise ValueError(f"{name} has shape {matrix.shape}; it must be 4 rows of 4 numbers")
    require_finite(name, matrix.ravel().tolist())
    if np.abs(matrix[3] - (0.0, 0.0, 0.0, 1.0)).max() > tolerance:
        raise ValueError(f"{name} has the last row {matrix[3].tolist()}; it must be 0, 0, 0, 1 (row by row)")
    turn = matrix[:3, :3]
    off = float(np.abs(turn @ turn.T - np.eye(3)).max())
    if off > 2.0 * tolerance:
        raise ValueError(f"{name} is no rigid motion: its axes are not unit and square to each other, off by {off:.2g}")
    if np.linalg.det(turn) < 0.0:
        raise ValueError(f"{name} is a mirror image (determinant -1); a rigid motion's determinant is 1")


def require_name(name: str, value: str) -> None:
    """Refuse a name that NAME_PATTERN does not match."""
    if re.fullmatch(NAME_PATTERN, value) is None:
        raise ValueError(f"{name} is {value!r}; a name is a letter, then letters, digits and underscores")
