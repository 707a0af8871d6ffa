"""Where the camera stands. Optical frame: x right, y down, z forward."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.conditions import DRAWN, Conditions
from boxwright.simulation.poses import Array, apply, inverse
from boxwright.types import Camera

Rng = np.random.Generator

DISTANCES_M = {
    "small": (0.7, 1.1),
    "carton": (0.75, 1.35),
    "cake": (0.75, 1.4),
    "pizza": (0.85, 1.6),
    "upright": (0.75, 1.6),
    "part_shut": (0.75, 1.6),
    "lying": (0.75, 1.6),
    "closed": (0.75, 1.8),
    "none": (0.8, 1.8),
}
FAR_M = (1.1, 1.8)
"""For the larger boxes."""
ASIDE_RAD = float(np.radians(75.0))
"""From the heading towards which a lying box opens."""
FARTHEST_M = 2.3
"""Beyond this, what does not fit in the frame is cut by it."""


def look_at(target_m: Array, azimuth_rad: float, elevation_rad: float, distance_m: float, roll_rad: float) -> Array:
    """camera_from_world of a camera `distance_m` from a target, at an elevation above its horizon."""
    flat = np.cos(elevation_rad)
    out = np.array([flat * np.cos(azimuth_rad), flat * np.sin(azimuth_rad), np.sin(elevation_rad)])
    right = np.array([-np.sin(azimuth_rad), np.cos(azimuth_rad), 0.0])
    down = np.cross(-out, right)
    axes = np.stack([right, down, -out])
    cos, sin = np.cos(roll_rad), np.sin(roll_rad)
    axes = np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]]) @ axes
    pose = np.eye(4)
    pose[:3, :3] = axes
    pose[:3, 3] = -axes @ (target_m + distance_m * out)
    return pose


def draw_view(
    rng: Rng,
    category: str,
    content: Array,
    camera: Camera,
    conditions: Conditions = DRAWN,
    opens_towards_rad: float | None = None,
) -> tuple[Array, float]:
    """camera_from_world, and the heading (rad, world) in which it looks; `content` (N, 3) should be in the frame.

    Elevations 20-90 degrees; one frame in eleven looks straight down, at any roll; one in twelve is cut by its edge.
    A box that opens towards a heading is looked at from there: from behind, lying boxes look like closed ones.
    What `conditions` set replaces what was drawn; a set distance is not made longer so that all fits.
    """
    azimuth = rng.uniform(0, 2 * np.pi)
    if opens_towards_rad is not None:
        azimuth = opens_towards_rad + rng.uniform(-ASIDE_RAD, ASIDE_RAD)
    is_down = rng.random() < 0.09
    elevation = np.radians(rng.uniform(84, 90) if is_down else 20 + 65 * rng.beta(1.2, 1.8))
    roll = rng.uniform(0, 2 * np.pi) if is_down else np.radians(rng.normal(0, 2.0))
    distance = rng.uniform(*DISTANCES_M.get(category, FAR_M))
    middle = (content.min(axis=0) + content.max(axis=0)) / 2
    is_cut = rng.random() < 0.08
    spread = 0.30 if is_cut else 0.10
    target = middle + np.append(rng.normal(0, spread, 2), 0.0)
    if conditions.elevation_deg is not None:
        elevation = np.radians(conditions.elevation_deg)
    if conditions.distance_m is not None:
        return look_at(middle, azimuth, elevation, conditions.distance_m, roll), float(azimuth + np.pi)
    for _ in range(12):
        pose = look_at(target, azimuth, elevation, distance, roll)
        if is_cut or _fits(content, pose, camera):
            break
        target, distance = (target + middle) / 2, min(distance * 1.06, FARTHEST_M)
    return pose, float(azimuth + np.pi)


def _fits(content: Array, camera_from_world: Array, camera: Camera) -> bool:
    x, y, z = apply(camera_from_world, content).T
    if z.min() < 0.5:
        return False
    u, v = camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy
    return bool(u.min() > 4 and v.min() > 4 and u.max() < camera.width - 5 and v.max() < camera.height - 5)


def up_in_camera(camera_from_world: Array) -> tuple[float, float, float]:
    """The world's up as a unit vector in the camera's frame."""
    x, y, z = camera_from_world[:3, :3] @ np.array([0.0, 0.0, 1.0])
    return float(x), float(y), float(z)


def position_in_world(camera_from_world: Array) -> NDArray[np.float64]:
    return inverse(camera_from_world)[:3, 3]
