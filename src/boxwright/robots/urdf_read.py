"""A robot from a URDF file: one chain of 6 or 7 revolute joints, limits, and collision shapes that are primitives.

URDF knows neither accelerations nor our gripper: the first are guessed, the second is the shipped robots'. Both stand
in `assumptions`; `boxwright robots FILE.urdf --toml OUT.toml` writes them down to be set right.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

from boxwright.robots.urdf_chain import Chain, chain_of, degrees, numbers, place
from boxwright.types import Gripper, Place, RobotBox, RobotCapsule, RobotFile, RobotJoint, RobotLink
from boxwright.types.truth import Vector

SECONDS_TO_TOP_SPEED = 0.25
"""What is guessed of accelerations, for arms of a few kilograms of payload."""

GRIPPER = Gripper(
    mass_kg=0.9,
    body_size_m=(0.07, 0.11, 0.07),
    finger_size_m=(0.02, 0.01, 0.08),
    opening_m=(0.0, 0.08),
    tool_point_m=(0.0, 0.0, 0.15),
)
"""The parallel-plate gripper of the shipped robots."""

MASSLESS_KG = 0.001
"""For links that tell no mass."""


def robot_of_urdf(text: str, name: str) -> RobotFile:
    """The robot of a URDF text; its ready pose is the middle of the joints' ranges, or 0 where a joint may stand there.

    Raises ValueError in one line: no chain of 6 or 7 revolute joints, a missing limit, a mesh.
    """
    try:
        root = ET.fromstring(text)
    except ET.ParseError as error:
        raise ValueError(f"is no XML: {error}") from None
    chain = chain_of(root)
    joints = tuple(_joint(element) for element in chain.joints)
    return RobotFile(
        format="boxwright.robot",
        version=1,
        name=name,
        description=f"from the URDF of {root.get('name', name)}",
        ready_deg=tuple(_ready_deg(joint) for joint in joints),
        assumptions=(
            f"accelerations: top speed within {SECONDS_TO_TOP_SPEED} s; URDF tells none",
            "gripper: the shipped robots'; URDF was read up to the chain's last link",
        ),
        flange=_flange(chain),
        joint=joints,
        link=tuple(_link(element) for element in chain.links),
        gripper=GRIPPER,
    )


def _joint(element: ET.Element) -> RobotJoint:
    name = element.get("name", "")
    limit = element.find("limit")
    values: dict[str, float] = {}
    for key in ("lower", "upper", "velocity"):
        told = None if limit is None else limit.get(key)
        if told is None:
            raise ValueError(
                f"joint {name}: its limit has no {key}; <limit lower upper velocity/> say how far and fast"
            )
        values[key] = numbers(told, 1, f"joint {name}: limit {key}")[0]
    axis = element.find("axis")
    xyz_m, rpy_rad = place(element, f"joint {name}")
    speed_deg_per_s = math.degrees(values["velocity"])
    direction = "1 0 0" if axis is None else axis.get("xyz", "1 0 0")
    return RobotJoint(
        name=name,
        limits_deg=(math.degrees(values["lower"]), math.degrees(values["upper"])),
        speed_deg_per_s=speed_deg_per_s,
        acceleration_deg_per_s2=speed_deg_per_s / SECONDS_TO_TOP_SPEED,
        xyz_m=xyz_m,
        rpy_deg=degrees(rpy_rad),
        axis=_vector(numbers(direction, 3, f"joint {name}: axis")),
    )


def _ready_deg(joint: RobotJoint) -> float:
    lower, upper = joint.limits_deg
    return 0.0 if lower <= 0.0 <= upper else (lower + upper) / 2.0


def _flange(chain: Chain) -> Place:
    xyz_m, rpy_rad = chain.last_link_from_flange
    return Place(xyz_m=xyz_m, rpy_deg=degrees(rpy_rad))


def _link(element: ET.Element) -> RobotLink:
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
    return RobotLink(name=name, mass_kg=max(mass_kg, MASSLESS_KG), capsules=tuple(capsules), boxes=tuple(boxes))


def _shape(collision: ET.Element, link: str) -> RobotCapsule | RobotBox:
    xyz_m, rpy_rad = place(collision, f"link {link}")
    if (box := collision.find("geometry/box")) is not None:
        size = _vector(numbers(box.get("size", ""), 3, f"link {link}: box size"))
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
    return (a[0] + sign * b[0], a[1] + sign * b[1], a[2] + sign * b[2])


def _vector(values: list[float]) -> Vector:
    return (values[0], values[1], values[2])
