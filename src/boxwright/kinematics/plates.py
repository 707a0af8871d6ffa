"""A panel as a plate of board: its mass and inertia, and the box that encloses it."""

from __future__ import annotations

import msgspec
import numpy as np

from boxwright.kinematics.transforms import Matrix

GRAMS_PER_KILOGRAM = 1000.0


class Plate(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """Mass (kg), centre of mass (3,) and inertia about it (3, 3), kg m^2, in the frame that the corners are told in."""

    mass_kg: float
    centre: Matrix
    inertia: Matrix


class EnclosingBox(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """A box along the axes of a panel's frame: its centre (3,) and its edges (3,), metres; the third is the board."""

    centre: Matrix
    size: Matrix


def plate(corners: Matrix, normal: Matrix, board_g_per_m2: float, thickness_m: float) -> Plate:
    """The plate between four corners (4, 3), in any one frame, in which `normal` (3,) is the panel's unit normal.

    Two triangles of even mass, exact for every convex quadrilateral: the second moment of a triangle a, b, c of mass m
    about the origin is m/12 (aa' + bb' + cc' + ss') with s = a + b + c (eqs. 37-38). The board adds m t^2/12 along the
    normal. So the moments are positive and the sum of two exceeds the third.
    """
    mass_kg, first, second = 0.0, np.zeros(3), np.zeros((3, 3))
    for triangle in (corners[[0, 1, 2]], corners[[0, 2, 3]]):
        area_m2 = float(np.linalg.norm(np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0]))) / 2.0
        mass = area_m2 * board_g_per_m2 / GRAMS_PER_KILOGRAM
        total = triangle.sum(axis=0)
        mass_kg += mass
        first += mass * total / 3.0
        second += mass / 12.0 * (triangle.T @ triangle + np.outer(total, total))
    centre = first / mass_kg
    spread = second - mass_kg * np.outer(centre, centre) + mass_kg * thickness_m**2 / 12.0 * np.outer(normal, normal)
    return Plate(mass_kg=mass_kg, centre=centre, inertia=np.trace(spread) * np.eye(3) - spread)


def enclosing_box(corners_panel: Matrix, thickness_m: float) -> EnclosingBox:
    """The box around corners (4, 3) in their panel's frame, as thick as the board.

    It is the panel itself where that is a rectangle on its first edge. A tapered panel's box has the corners that the
    panel lacks: for a robot that keeps clear of it, too much is safe and too little is not.
    """
    low, high = corners_panel.min(axis=0), corners_panel.max(axis=0)
    size = high - low
    return EnclosingBox(centre=(low + high) / 2.0, size=np.array([size[0], size[1], thickness_m]))
