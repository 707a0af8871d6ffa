"""The one chain of revolute joints in a URDF, fixed joints melted into the links before them."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass

from boxwright.types.truth import Vector

AXES = (6, 7)
ORIGIN: tuple[Vector, Vector] = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))


@dataclass(frozen=True)
class Chain:
    """The base and one link for each joint; after the last link, where a fixed joint puts the flange."""

    links: list[ET.Element]
    joints: list[ET.Element]
    last_link_from_flange: tuple[Vector, Vector]


def chain_of(root: ET.Element) -> Chain:
    """The chain of a URDF's root element.

    Raises ValueError where there is no chain of 6 or 7 revolute joints, or something fixed lies between them.
    """
    links = {link.get("name", ""): link for link in root.findall("link")}
    turning = {_name(joint, "parent"): joint for joint in root.findall("joint") if joint.get("type") == "revolute"}
    fixed = {_name(joint, "parent"): joint for joint in root.findall("joint") if joint.get("type") == "fixed"}
    endless = [joint.get("name") for joint in root.findall("joint") if joint.get("type") == "continuous"]
    if endless:
        raise ValueError(f"joint {endless[0]}: has no limits (continuous); make it revolute with a <limit>")
    children = {_name(joint, "child") for joint in turning.values()}
    starts = [parent for parent in turning if parent not in children]
    if len(starts) != 1:
        raise ValueError(f"has {len(starts)} chains of revolute joints; an arm is one, without a gripper's joints")
    names, joints = [starts[0]], []
    while names[-1] in turning:
        joints.append(turning[names[-1]])
        names.append(_name(joints[-1], "child"))
    if len(joints) not in AXES or len(joints) != len(turning):
        raise ValueError(f"has {len(turning)} revolute joints, {len(joints)} in a row; an arm has 6 or 7 in a row")
    missing = [name for name in names if name not in links]
    if missing:
        raise ValueError(f"link {missing[0]}: is named by a joint but is not there")
    last = fixed.get(names[-1])
    flange = ORIGIN if last is None else place(last, f"joint {last.get('name')}")
    return Chain([links[name] for name in names], joints, flange)


def place(element: ET.Element, where: str) -> tuple[Vector, Vector]:
    """xyz (m) and rpy (rad) of an element's origin; zeros where it tells none."""
    origin = element.find("origin")
    if origin is None:
        return ORIGIN
    xyz = numbers(origin.get("xyz", "0 0 0"), 3, f"{where}: origin xyz")
    rpy = numbers(origin.get("rpy", "0 0 0"), 3, f"{where}: origin rpy")
    return (xyz[0], xyz[1], xyz[2]), (rpy[0], rpy[1], rpy[2])


def numbers(text: str, count: int, where: str) -> list[float]:
    """So many finite numbers of a text."""
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not all(math.isfinite(value) for value in values):
        raise ValueError(f"{where} is {text!r}; must be {count} finite numbers")
    return values


def vector(values: list[float]) -> Vector:
    """Three numbers of a list."""
    return (values[0], values[1], values[2])


def degrees(angles_rad: Vector) -> Vector:
    """Three angles in degrees."""
    return (math.degrees(angles_rad[0]), math.degrees(angles_rad[1]), math.degrees(angles_rad[2]))


def _name(joint: ET.Element, kind: str) -> str:
    element = joint.find(kind)
    return "" if element is None else element.get("link", "")
