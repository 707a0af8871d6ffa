"""Floors, tables and walls. World frame, z up, the support at z = 0."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.meshes import cuboid, rectangle
from boxwright.simulation.poses import apply, rotation, standing, translation
from boxwright.simulation.scene import Body

Array = NDArray[np.float64]
Rng = np.random.Generator

FLOOR_SIZE_M = 12.0
OFF_WALL_M = 0.2
"""No sensor stands nearer to a wall: its projector is 75 mm to the left."""
FLOOR_COLORS = ((150, 150, 150), (128, 104, 80), (176, 168, 158), (96, 100, 108))
TABLE_COLORS = ((170, 140, 110), (205, 200, 195), (110, 84, 60))


class Surroundings(msgspec.Struct, frozen=True, eq=False):
    """What stands around the scene, and how far from the origin its support reaches in x and y, metres."""

    bodies: list[Body]
    reach_m: tuple[float, float]


def draw_support(rng: Rng, extent_m: float) -> Surroundings:
    """The floor, or a table of at least `extent_m` across with the floor 0.7-0.8 m below."""
    floor = rectangle((FLOOR_SIZE_M, FLOOR_SIZE_M))
    color = FLOOR_COLORS[int(rng.integers(len(FLOOR_COLORS)))]
    if rng.random() < 0.6:
        return Surroundings([Body(floor, color)], (FLOOR_SIZE_M, FLOOR_SIZE_M))
    below_m = float(rng.uniform(0.7, 0.8))
    bodies, reach = _table(rng, extent_m, below_m)
    return Surroundings([Body(floor - [0, 0, below_m], color), *bodies], reach)


def _table(rng: Rng, extent_m: float, below_m: float) -> tuple[list[Body], tuple[float, float]]:
    half = extent_m / 2 + rng.uniform(0.05, 0.6, 2)
    offset = rng.uniform(-0.3, 0.3, 2) * (half - extent_m / 2)
    color = TABLE_COLORS[int(rng.integers(len(TABLE_COLORS)))]
    top = apply(translation([*offset, -0.03]), cuboid((*(2 * half), 0.03)))
    leg = cuboid((0.05, 0.05, below_m - 0.03))
    legs = [
        apply(translation([*(offset + s * (half - 0.06)), -below_m]), leg) for s in ([1, 1], [1, -1], [-1, 1], [-1, -1])
    ]
    reach = half - np.abs(offset)
    return [Body(part, color) for part in (top, *legs)], (float(reach[0]), float(reach[1]))


def draw_walls(rng: Rng, support: Surroundings, away: float, distance_m: float) -> list[Body]:
    """Now and then a wall `distance_m` behind the scene, `away` being the camera's heading; sometimes a corner."""
    if rng.random() > 0.35:
        return []
    floor_z = min(float(body.triangles[..., 2].min()) for body in support.bodies)
    headings = [away + rng.normal(0, 0.3)]
    if rng.random() < 0.3:
        headings.append(headings[0] + np.pi / 2)
    shade = int(rng.integers(150, 225))
    return [Body(_wall(heading, distance_m, floor_z), (shade, shade, shade)) for heading in headings]


def is_before(place_m: Array, wall: Body) -> bool:
    """Is a place well on the side of a wall on which the world's origin is: do sensors there see the scene?"""
    corner, second, third = wall.triangles[0]
    normal = np.cross(second - corner, third - corner)
    inward = normal / np.linalg.norm(normal) * np.sign(normal @ -corner)
    return bool(inward @ (place_m - corner) > OFF_WALL_M)


def _wall(heading: float, distance_m: float, floor_z: float) -> Array:
    upright = rotation([0, 1, 0], np.pi / 2)
    pose = standing(distance_m * np.cos(heading), distance_m * np.sin(heading), heading, floor_z + 2.0)
    return apply(pose @ upright, rectangle((4.0, 8.0)))
