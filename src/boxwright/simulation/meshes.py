"""Triangles of simple bodies; (T, 3, 3) float64, metres. Nothing here knows what a body is for."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def shell(front: Array, back: Array) -> Array:
    """A closed board between two grids of points, each (M, N, 3): both faces and the four edges."""
    rims = [
        (front[0], back[0]),
        (front[-1], back[-1]),
        (front[:, 0], back[:, 0]),
        (front[:, -1], back[:, -1]),
    ]
    edges = [sheet(np.stack(rim)) for rim in rims]
    return np.concatenate([sheet(front), sheet(back), *edges])


def sheet(grid: Array) -> Array:
    """Two triangles for each cell of a grid (M, N, 3)."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)]).reshape(-1, 3, 3)


def cuboid(size_m: ArrayLike) -> Array:
    """A solid of (x, y, z) size that stands on z = 0, centred in x and y."""
    x, y, z = np.asarray(size_m, dtype=float)
    floor = np.array([[[-x, -y, 0], [x, -y, 0]], [[-x, y, 0], [x, y, 0]]]) / 2
    return shell(floor, floor + np.array([0.0, 0.0, z]))


def revolve(profile_m: ArrayLike, segments: int = 20) -> Array:
    """The surface that a polyline of (radius, z) sweeps about the z axis."""
    profile = np.asarray(profile_m, dtype=float)
    turn = np.linspace(0.0, 2 * np.pi, segments + 1)
    turn[-1] = 0.0
    radius, z = profile[:, :1], profile[:, 1:]
    grid = np.stack(
        [radius * np.cos(turn), radius * np.sin(turn), np.broadcast_to(z, (len(profile), segments + 1))], axis=2
    )
    triangles = sheet(grid)
    area = np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)
    return np.ascontiguousarray(triangles[area > 1e-12])


def sphere(radius_m: float, rows: int = 9) -> Array:
    """A ball that touches z = 0 from above."""
    tilt = np.linspace(-np.pi / 2, np.pi / 2, rows)
    return revolve(np.stack([radius_m * np.cos(tilt), radius_m * (1 + np.sin(tilt))], axis=1), 2 * rows)


def rectangle(size_m: ArrayLike) -> Array:
    """A flat (x, y) rectangle in z = 0, centred."""
    x, y = np.asarray(size_m, dtype=float)
    return sheet(np.array([[[-x, -y, 0], [x, -y, 0]], [[-x, y, 0], [x, y, 0]]]) / 2)
