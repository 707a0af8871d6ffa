"""A link of a URDF: its mass and its collision shapes, boxes and capsules."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

from boxwright.robots.urdf_chain import degrees, numbers, place, vector
from boxwright.types import RobotBox, RobotCapsule, RobotLink
from boxwright.types.truth import Vector

MASSLESS_KG = 0.001
"""For links that tell no mass."""

WITHIN_M = 1e-9
"""A sphere that sticks out of a cylinder's capsule by no more adds nothing: URDF has a capsule in three pieces."""

METRE_DIGITS = 15
"""Digits that are kept behind the point: what turns of vectors round off is beyond."""


def link_of(element: ET.Element) -> RobotLink:
    """A link's mass and collision shapes, in its own frame. Raises ValueError for a shape that is no primitive."""
    name = element.get("name", "")
    mass = element.find("inertial/mass")
    mass_kg = MASSLESS_KG if mass is None else numbers(mass.get("value", ""), 1, f"link {name}: mass")[0]
    capsules, boxes = [], []
    for collision in element.findall("collision"):
        shape = _shape(collision, name)
        if isinstance(shape, RobotBox):
            boxes.append(shape)
        else:
            capsules.append(shape)
    kept = tuple(capsule for k, capsule in enumerate(capsules) if not _lies_in_another(k, capsules))
    return RobotLink(name=name, mass_kg=max(mass_kg, MASSLESS_KG), capsules=kept, boxes=tuple(boxes))


def _lies_in_another(number: int, capsules: list[RobotCapsule]) -> bool:
    """A sphere at an end of a cylinder as thick: the cylinder's capsule has it."""
    ball = capsules[number]
    if ball.from_m != ball.to_m:
        return False
    others = (other for other in capsules if other.from_m != other.to_m)
    return any(
        min(math.dist(ball.from_m, end) for end in (other.from_m, other.to_m)) + ball.radius_m - other.radius_m
        < WITHIN_M
        for other in others
    )


def _shape(collision: ET.Element, link: str) -> RobotCapsule | RobotBox:
    xyz_m, rpy_rad = place(collision, f"link {link}")
    if (box := collision.find("geometry/box")) is not None:
        size = vector(numbers(box.get("size", ""), 3, f"link {link}: box size"))
        return RobotBox(centre_m=xyz_m, size_m=size, rpy_deg=degrees(rpy_rad))
    if (sphere := collision.find("geometry/sphere")) is not None:
        radius_m = numbers(sphere.get("radius", ""), 1, f"link {link}: sphere radius")[0]
        return RobotCapsule(from_m=xyz_m, to_m=xyz_m, radius_m=radius_m)
    if (cylinder := collision.find("geometry/cylinder")) is not None:
        radius_m = numbers(cylinder.get("radius", ""), 1, f"link {link}: cylinder radius")[0]
        length_m = numbers(cylinder.get("length", ""), 1, f"link {link}: cylinder length")[0]
        # A cylinder's capsule goes from end to end and sticks out by the radius: it encloses, no more.
        half = _turned(rpy_rad, length_m / 2.0)
        return RobotCapsule(from_m=_sum(xyz_m, half, -1.0), to_m=_sum(xyz_m, half, 1.0), radius_m=radius_m)
    raise ValueError(f"link {link}: its collision shape is no primitive; give boxes, cylinders or spheres for meshes")


def _turned(rpy_rad: Vector, z_m: float) -> Vector:
    """The z axis, times a length, after fixed-axis turns."""
    roll, pitch, yaw = rpy_rad
    x = math.cos(roll) * math.sin(pitch)
    y = -math.sin(roll)
    return (
        z_m * (math.cos(yaw) * x - math.sin(yaw) * y),
        z_m * (math.sin(yaw) * x + math.cos(yaw) * y),
        z_m * math.cos(roll) * math.cos(pitch),
    )


def _sum(a: Vector, b: Vector, sign: float) -> Vector:
    x, y, z = (round(p + sign * q, METRE_DIGITS) + 0.0 for p, q in zip(a, b, strict=True))
    return (x, y, z)
