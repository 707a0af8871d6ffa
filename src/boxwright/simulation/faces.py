"""The flat faces of bodies that have no panels: floors, walls, tables, books, the tops of cans."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

SAME_CORNER_M = 1e-6
SAME_PLANE_DEG = 0.05
CURVED_DEG = 30.0
"""Round bodies turn by 20 degrees at most from facet to facet, flat ones by much more from face to face."""
FACET_TRIANGLES = 2
"""A facet of a round body is one quadrangle; its flat ends are fans of many triangles."""


def flat_faces(triangles: Array) -> Indices:
    """The flat face (T,) of each triangle (T, 3, 3) of a body, numbered from 0; -1 where the body is round.

    A face is what hangs together over edges and lies in one plane. A facet that a round body is approximated by is
    none: it is a quadrangle that a neighbour leans from by less than 30 degrees.
    """
    normals = unit_normals(triangles)
    first, second = _neighbours(triangles)
    lean_deg = np.degrees(np.arccos(np.clip(np.abs(np.sum(normals[first] * normals[second], axis=1)), 0.0, 1.0)))
    together = lean_deg < SAME_PLANE_DEG
    faces = _joined(len(triangles), first[together], second[together])
    is_smooth = ~together & (lean_deg < CURVED_DEG)
    has_smooth_edge = np.zeros(len(triangles), dtype=bool)
    has_smooth_edge[faces[first[is_smooth]]] = True
    has_smooth_edge[faces[second[is_smooth]]] = True
    is_facet = np.bincount(faces, minlength=len(triangles)) <= FACET_TRIANGLES
    is_round = (has_smooth_edge & is_facet)[faces]
    numbered = np.full(len(triangles), -1)
    numbered[~is_round] = np.unique(faces[~is_round], return_inverse=True)[1]
    return numbered


def unit_normals(triangles: Array) -> Array:
    """(T, 3), of either sign."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals: Array = across / np.linalg.norm(across, axis=1, keepdims=True)
    return normals


def _neighbours(triangles: Array) -> tuple[Indices, Indices]:
    """Pairs of triangles that share an edge."""
    rounded = np.round(triangles.reshape(-1, 3) / SAME_CORNER_M).astype(np.int64)
    corners = np.unique(rounded, axis=0, return_inverse=True)[1].reshape(-1, 3)
    edges = np.sort(corners[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
    keys = edges[:, 0] * (corners.max() + 1) + edges[:, 1]
    order = np.argsort(keys, kind="stable")
    is_shared = keys[order[:-1]] == keys[order[1:]]
    return order[:-1][is_shared] // 3, order[1:][is_shared] // 3


def _joined(count: int, first: Indices, second: Indices) -> Indices:
    """For each of `count` things the lowest of those that pairs join it with."""
    lowest = np.arange(count)
    while True:
        both = np.minimum(lowest[first], lowest[second])
        joined = lowest.copy()
        np.minimum.at(joined, first, both)
        np.minimum.at(joined, second, both)
        if np.array_equal(joined, lowest):
            return lowest
        lowest = joined
