"""Boards as solid rectangles: what MuJoCo collides fast and with enough points for a thin plate to rest on.

A board that tapers is a stair of rectangles across its taper, no step wider than STEP_M beside the true edge.
"""

from __future__ import annotations

from itertools import pairwise

import msgspec
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEP_M = 0.003
MOST_STEPS = 6


class Slab(msgspec.Struct, frozen=True, eq=False):
    """A cuboid: its centre and axes (columns of a rotation), world frame, and half its edges, metres."""

    centre: Array
    axes: Array
    half_m: Array


class Trim(msgspec.Struct, frozen=True, kw_only=True):
    """How much of a panel is left out at its first edge, at its far edge and at each of the two other ends, metres."""

    near_m: float = 0.0
    far_m: float = 0.0
    ends_m: float = 0.0


def panel_axes(corners: Array) -> Array:
    """Columns: x along the first edge, y in the panel towards the far edge, z = x cross y; corners (4, 3)."""
    x = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    y = corners.mean(axis=0) - (corners[0] + corners[1]) / 2.0
    y -= (y @ x) * x
    y /= np.linalg.norm(y)
    return np.column_stack([x, y, np.cross(x, y)])


def area_m2(corners: Array) -> float:
    """Of a flat panel with corners (4, 3)."""
    return float(np.linalg.norm(np.cross(corners[2] - corners[0], corners[3] - corners[1])) / 2.0)


def slabs_of(corners: Array, thickness_m: float, trim: Trim | None = None, *, stair: bool = True) -> list[Slab]:
    """The slabs of a panel, mid-board in their middle; at least one, in the order away from the first edge.

    Without a `stair` it is one, as wide as the panel is on average. Raises ValueError for a panel that leaves no board.
    """
    cut = trim or Trim()
    axes, origin = panel_axes(corners), (corners[0] + corners[1]) / 2.0
    flat = (corners - origin) @ axes[:, :2]
    depth_m = (flat[2, 1] + flat[3, 1]) / 2.0
    low = np.array([flat[0, 0], flat[3, 0]]) + cut.ends_m
    high = np.array([flat[1, 0], flat[2, 0]]) - cut.ends_m
    edges_y = np.linspace(cut.near_m, depth_m - cut.far_m, (_steps(low, high) if stair else 1) + 1)
    made = []
    for start, end in pairwise(edges_y):
        share = (start + end) / 2.0 / depth_m
        left, right = low[0] + share * (low[1] - low[0]), high[0] + share * (high[1] - high[0])
        centre = origin + axes @ np.array([(left + right) / 2.0, (start + end) / 2.0, 0.0])
        half_m = np.array([right - left, end - start, thickness_m]) / 2.0
        if (half_m <= 0.0).any():
            raise ValueError(f"a panel of {np.round(flat, 4).tolist()} m leaves no board {thickness_m} m thick")
        made.append(Slab(centre, axes, half_m))
    return made


def _steps(low: Array, high: Array) -> int:
    """A stair of n steps leaves at most a 2n-th of the taper between step and edge."""
    taper_m = max(abs(low[1] - low[0]), abs(high[1] - high[0]))
    return int(np.clip(np.ceil(taper_m / (2.0 * STEP_M)), 1, MOST_STEPS))
