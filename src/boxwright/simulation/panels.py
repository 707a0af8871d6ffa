"""A box's boards as triangles, with the corners that the truth reports. Box frame: z = 0 under the base, z up."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.boxes import Flap, OpenBox, Tuck
from boxwright.simulation.meshes import sheet, shell

Array = NDArray[np.float64]

UP = np.array([0.0, 0.0, 1.0])
SIDE_CELLS = (6, 4)
FLAP_CELLS = 6
CREASE_CELLS = 8
BASE_GAP_M = 0.0004
"""The base ends this far from the sides' inner faces, so that a dented side does not touch it."""


class Panel(msgspec.Struct, frozen=True, eq=False):
    """One board. `corners` (4, 3) at mid-board in the order of docs/formats.md, `triangles` (T, 3, 3); box frame."""

    name: str
    parent: str | None
    angle_rad: float | None
    corners: Array
    triangles: Array
    extra: bool = False


def build_panels(box: OpenBox) -> list[Panel]:
    """Base, sides, flaps, then flaps on flaps; only those that exist."""
    panels = [_base(box), *(_side(box, k) for k in range(4))]
    if box.is_closed:
        panels.append(_top(box))
    for k, flap in enumerate(box.flaps):
        if flap is not None:
            panels += _flap_and_tuck(box, k, flap)
    return panels


def outline(box: OpenBox, offset_m: float = 0.0) -> Array:
    """The four starts of the sides (4, 2), the mid-surfaces moved outward by `offset_m` (mitred at the corners)."""
    along, across = _plan_axes(box)
    # Moving both pairs of walls by `offset_m` along their normals lengthens the edges by this much.
    grow = 2 * offset_m / np.cos(box.rack_rad)
    half_x, half_y = (box.length_m + grow) / 2 * along, (box.width_m + grow) / 2 * across
    return np.array([-half_x - half_y, half_x - half_y, half_x + half_y, -half_x + half_y])


def _plan_axes(box: OpenBox) -> tuple[Array, Array]:
    return np.array([1.0, 0.0]), np.array([np.sin(box.rack_rad), np.cos(box.rack_rad)])


def _at(plan: Array, z: float) -> Array:
    return np.concatenate([plan, np.full((*plan.shape[:-1], 1), z)], axis=-1)


def _base(box: OpenBox) -> Panel:
    return _between_sides(box, "base", 0.0)


def _top(box: OpenBox) -> Panel:
    return _between_sides(box, "top", box.height_m - box.board_m)


def _between_sides(box: OpenBox, name: str, under_m: float) -> Panel:
    inner = outline(box, -box.board_m / 2 - BASE_GAP_M)
    grid = _at(inner[[0, 1, 3, 2]].reshape(2, 2, 2), under_m)
    triangles = shell(grid, grid + box.board_m * UP)
    return Panel(name, None, None, _at(outline(box), under_m + box.board_m / 2), triangles)


def _side(box: OpenBox, k: int) -> Panel:
    mid, outer, inner = (outline(box, s * box.board_m / 2)[[k, (k + 1) % 4]] for s in (0, 1, -1))
    corners = np.concatenate([_at(mid, box.height_m), _at(mid[::-1], box.board_m / 2)])
    u, v = (np.linspace(0, 1, n + 1) for n in SIDE_CELLS)
    direction = mid[1] - mid[0]
    outward = np.array([direction[1], -direction[0], 0.0]) / np.linalg.norm(direction)
    swell = box.bulges_m[k] * np.outer(np.sin(np.pi * u), np.sin(np.pi * v) ** 2)[..., None] * outward
    faces = [_wall_grid(ends, box.height_m, u, v) + swell for ends in (outer, inner)]
    return Panel(f"side{k}", None, None, corners, shell(*faces))


def _wall_grid(ends: Array, height_m: float, u: Array, v: Array) -> Array:
    plan = ends[0] + u[:, None] * (ends[1] - ends[0])
    z = height_m * (1 - v)
    grid = np.empty((len(u), len(v), 3))
    grid[..., :2] = plan[:, None]
    grid[..., 2] = z
    return grid


def _flap_and_tuck(box: OpenBox, k: int, flap: Flap) -> list[Panel]:
    start, end = _at(outline(box)[[k, (k + 1) % 4]], box.height_m)
    along = (end - start) / np.linalg.norm(end - start)
    hinge = np.array([start + flap.inset_m * along, end - flap.inset_m * along])
    inward = np.cross(UP, along)
    taper = (flap.taper_start_m, flap.taper_end_m)
    triangles, free_edge = _strip(hinge, inward, box.board_m, flap.length_m, flap.angle_rad, flap.bend_rad, taper)
    corners = _flat_corners(hinge, inward, flap.length_m, flap.angle_rad, taper)
    panels = [Panel(f"flap{k}", f"side{k}", flap.angle_rad, corners, triangles)]
    if flap.tuck is not None:
        panels.append(_tuck(box, k, flap, flap.tuck, free_edge, inward))
    return panels


def _tuck(box: OpenBox, k: int, flap: Flap, tuck: Tuck, hinge: Array, inward: Array) -> Panel:
    """Its hinge is where the flap's free edge really is, bent or not."""
    direction_rad = flap.angle_rad - tuck.angle_rad
    taper = (tuck.taper_m, tuck.taper_m)
    triangles, _ = _strip(hinge, inward, box.board_m, tuck.length_m, direction_rad, 0.0, taper)
    corners = _flat_corners(hinge, inward, tuck.length_m, direction_rad, taper)
    return Panel(f"tuck{k}", f"flap{k}", tuck.angle_rad, corners, triangles, extra=True)


def _direction(inward: Array, angle_rad: Array | float) -> Array:
    angle = np.asarray(angle_rad)[..., None]
    direction: Array = np.cos(angle) * inward + np.sin(angle) * UP
    return direction


def _flat_corners(hinge: Array, inward: Array, length_m: float, angle_rad: float, taper: tuple[float, float]) -> Array:
    along = (hinge[1] - hinge[0]) / np.linalg.norm(hinge[1] - hinge[0])
    reach = length_m * _direction(inward, angle_rad)
    return np.array([hinge[0], hinge[1], hinge[1] + reach - taper[1] * along, hinge[0] + reach + taper[0] * along])


def _strip(
    hinge: Array,
    inward: Array,
    board_m: float,
    length_m: float,
    angle_rad: float,
    bend_rad: float,
    taper: tuple[float, float],
) -> tuple[Array, Array]:
    """A board from a hinge edge, bent on a circle: its triangles, and its free edge (2, 3) at mid-board."""
    share = np.linspace(0, 1, (FLAP_CELLS if bend_rad else 1) + 1)
    tangent_rad = angle_rad + bend_rad * share
    # The chord from the hinge turns by half as much as the tangent and shortens by sinc.
    chord_m = length_m * share * np.sinc(bend_rad * share / (2 * np.pi))
    path = chord_m[:, None] * _direction(inward, angle_rad + bend_rad * share / 2)
    along = (hinge[1] - hinge[0]) / np.linalg.norm(hinge[1] - hinge[0])
    shrink = share[:, None] * along
    middle = np.stack([hinge[0] + path + taper[0] * shrink, hinge[1] + path - taper[1] * shrink])
    half_board = board_m / 2 * _direction(inward, tangent_rad + np.pi / 2)
    triangles = np.concatenate([shell(middle + half_board, middle - half_board), _crease(hinge, inward, board_m / 2)])
    return triangles, middle[:, -1]


def _crease(hinge: Array, inward: Array, radius_m: float) -> Array:
    """The rounding where a board is folded: without it two boards at an angle leave an open wedge along the hinge."""
    around = radius_m * _direction(inward, np.linspace(0.0, 2 * np.pi, CREASE_CELLS + 1))
    return sheet(hinge[:, None] + around)
