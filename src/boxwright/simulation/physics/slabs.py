"""Boards as solid rectangles: what MuJoCo collides fast and with enough points for a thin plate to rest on.

A board that tapers is a stair within its outline, and a strip along each slanting edge, which covers the stair: an edge
of steps would catch on the edges of other boards.
"""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STEP_M = 0.012
MOST_STEPS = 3
"""A stair has a step for so much of the taper, and so many at the most."""
EVEN_M = 0.0005
"""Edges that taper by less than this are taken as parallel."""


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


def slabs_of(corners: Array, thickness_m: float, trim: Trim | None = None, *, taper: bool = True) -> list[Slab]:
    """The slabs of a panel, mid-board in their middle; at least one: steps in the order away from the first edge, then
    a strip along each edge that tapers.

    Without `taper` it is one, as wide as the panel is on average. Raises ValueError for a panel that leaves no board.
    """
    cut = trim or Trim()
    axes, origin = panel_axes(corners), (corners[0] + corners[1]) / 2.0
    flat = (corners - origin) @ axes[:, :2]
    depth_m = (flat[2, 1] + flat[3, 1]) / 2.0
    # Where the two edges beside the first one begin and end.
    ends_x = np.array([flat[[0, 3], 0] + cut.ends_m, flat[[1, 2], 0] - cut.ends_m])
    shares = np.array([cut.near_m, depth_m - cut.far_m]) / depth_m
    span_y = depth_m * shares
    edges_x = ends_x[:, :1] + shares * (ends_x[:, 1:] - ends_x[:, :1])
    is_even = not taper or np.abs(edges_x[:, 1] - edges_x[:, 0]).max() <= EVEN_M
    slabs = [_mean(edges_x, span_y)] if is_even else _steps(edges_x, span_y) + _strips(edges_x, span_y)
    if any((slab.half_m <= 0.0).any() for slab in slabs) or thickness_m <= 0.0:
        panel_mm = f"{1000.0 * np.ptp(flat[:, 0]):.0f} x {1000.0 * depth_m:.0f} mm"
        raise ValueError(f"a panel of {panel_mm} leaves no room for board {1000.0 * thickness_m:g} mm thick")
    return [slab.placed(axes, origin, thickness_m) for slab in slabs]


class _Flat(msgspec.Struct, frozen=True, eq=False):
    """A rectangle in a panel's plane: its middle (2), the unit vector (2) along its first side, half its sides (2)."""

    middle: Array
    along: Array
    half_m: Array

    def placed(self, axes: Array, origin: Array, thickness_m: float) -> Slab:
        turned = np.array([[self.along[0], -self.along[1], 0.0], [self.along[1], self.along[0], 0.0], [0.0, 0.0, 1.0]])
        return Slab(origin + axes[:, :2] @ self.middle, axes @ turned, np.append(self.half_m, thickness_m / 2.0))


def _mean(edges_x: Array, span_y: Array) -> _Flat:
    left, right = edges_x.mean(axis=1)
    return _upright(left, right, *span_y)


def _upright(left: float, right: float, low: float, high: float) -> _Flat:
    return _Flat(
        np.array([left + right, low + high]) / 2.0, np.array([1.0, 0.0]), np.array([right - left, high - low]) / 2.0
    )


def _steps(edges_x: Array, span_y: Array) -> list[_Flat]:
    """A stair within the panel, its steps as deep as each other."""
    count = _step_count(edges_x)
    shares = np.linspace(0.0, 1.0, count + 1)
    edges = edges_x[:, :1] + shares * (edges_x[:, 1:] - edges_x[:, :1])
    heights = span_y[0] + shares * (span_y[1] - span_y[0])
    return [
        _upright(edges[0, k : k + 2].max(), edges[1, k : k + 2].min(), heights[k], heights[k + 1]) for k in range(count)
    ]


def _strips(edges_x: Array, span_y: Array) -> list[_Flat]:
    """Of each edge that tapers a strip inside it, wide enough to cover the stair's steps, and within the panel."""
    strips = []
    for (start_x, end_x), inward in zip(edges_x, (1.0, -1.0), strict=True):
        start, end = np.array([start_x, span_y[0]]), np.array([end_x, span_y[1]])
        length_m = float(np.linalg.norm(end - start))
        along = (end - start) / length_m
        across = inward * np.array([along[1], -along[0]])
        if abs(end_x - start_x) <= EVEN_M:
            continue
        wide_m = abs(end_x - start_x) / _step_count(edges_x) * along[1]
        # The strip's inner corner does not leave the panel at the end where the panel is wider.
        cut_m = abs(across[1]) / along[1] * wide_m
        first, last = (cut_m, length_m) if across[1] < 0.0 else (0.0, length_m - cut_m)
        middle = start + along * (first + last) / 2.0 + across * wide_m / 2.0
        strips.append(_Flat(middle, along, np.array([last - first, wide_m]) / 2.0))
    return strips


def _step_count(edges_x: Array) -> int:
    taper_m = float(np.abs(edges_x[:, 1] - edges_x[:, 0]).max())
    return int(np.clip(np.ceil(taper_m / STEP_M), 1, MOST_STEPS))
