"""A robot as URDF: links with primitive shapes, joints with limits, the gripper's fingers as prismatic joints."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.kinematics.transforms import rigid, roll_pitch_yaw
from boxwright.robots.robot import Robot
from boxwright.robots.urdf_beyond import beyond_element
from boxwright.types import RobotCapsule, RobotLink

Array = NDArray[np.float64]

FINGER_MASS_KG = 0.05
"""Taken from the gripper's mass for each finger: an assumption."""
EFFORT_N_M = 0.0
"""URDF asks every joint for an effort; the files tell none."""
FINGER_SPEED_M_PER_S = 0.1


def save_robot_urdf(robot: Robot, path: str | PathLike[str]) -> None:
    """Write a robot as URDF; equal robots give equal bytes. Raises OSError."""
    Path(path).write_text(urdf_of_robot(robot), encoding="utf-8")


def urdf_of_robot(robot: Robot) -> str:
    """A robot's URDF: metres, radians, kilograms. Joint positions mean what they mean in the robot's file.

    Links `flange` and `tool` are empty frames; `gripper`, `finger_left` and `finger_right` hang on the flange. A
    capsule is a cylinder and two spheres. What URDF cannot tell stands in an element of our own (docs/robots.md).
    """
    root = ET.Element("robot", name=robot.name)
    root.append(ET.Comment(f" Made by boxwright. {robot.file.description}. Inertias are those of the shapes. "))
    mujoco = ET.SubElement(root, "mujoco")
    ET.SubElement(mujoco, "compiler", fusestatic="false")
    links = robot.file.link
    for link in links:
        root.append(_link(link))
    for k, joint in enumerate(robot.file.joint):
        element = _tie(joint.name, "revolute", links[k].name, links[k + 1].name, robot.arm.parent_from_joint[k])
        ET.SubElement(element, "axis", xyz=_numbers(robot.arm.axes[k]))
        lower, upper = (math.radians(limit) for limit in joint.limits_deg)
        _limit(element, lower, upper, math.radians(joint.speed_deg_per_s))
        root.append(element)
    _add_tool(root, robot)
    ET.indent(root)
    root.append(beyond_element(robot.file))
    return '<?xml version="1.0"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _add_tool(root: ET.Element, robot: Robot) -> None:
    gripper = robot.file.gripper
    body, finger = np.array(gripper.body_size_m), np.array(gripper.finger_size_m)
    for name in ("flange", "tool"):
        ET.SubElement(root, "link", name=name)
    last = robot.file.link[-1].name
    root.append(_tie("to_flange", "fixed", last, "flange", robot.arm.last_link_from_flange))
    root.append(_tie("to_tool", "fixed", "flange", "tool", rigid(np.eye(3), gripper.tool_point_m)))
    root.append(_box_link("gripper", gripper.mass_kg - 2.0 * FINGER_MASS_KG, body, [0.0, 0.0, body[2] / 2.0]))
    root.append(_tie("to_gripper", "fixed", "flange", "gripper", np.eye(4)))
    least, widest = gripper.opening_m
    for name, side in (("finger_left", 1.0), ("finger_right", -1.0)):
        root.append(_box_link(name, FINGER_MASS_KG, finger, [0.0, 0.0, finger[2] / 2.0]))
        closed = rigid(np.eye(3), [0.0, side * finger[1] / 2.0, body[2]])
        slide = _tie(f"to_{name}", "prismatic", "gripper", name, closed)
        ET.SubElement(slide, "axis", xyz=_numbers([0.0, side, 0.0]))
        _limit(slide, least / 2.0, widest / 2.0, FINGER_SPEED_M_PER_S)
        root.append(slide)


def _link(link: RobotLink) -> ET.Element:
    element = ET.Element("link", name=link.name)
    shapes: list[tuple[Array, ET.Element, float]] = []
    for capsule in link.capsules:
        shapes += _capsule(capsule)
    for box in link.boxes:
        place = rigid(_rotation(box.rpy_deg), box.centre_m)
        shapes.append((place, ET.Element("box", size=_numbers(box.size_m)), float(np.prod(box.size_m))))
    element.append(_inertial(link.mass_kg, shapes))
    for kind in ("visual", "collision"):
        for place, geometry, _ in shapes:
            shape = ET.SubElement(element, kind)
            shape.append(_origin(place))
            ET.SubElement(shape, "geometry").append(geometry)
    return element


def _capsule(capsule: RobotCapsule) -> list[tuple[Array, ET.Element, float]]:
    """Its spheres, and its cylinder where it has a length: places, geometries and volumes."""
    start, end, radius = np.array(capsule.from_m), np.array(capsule.to_m), capsule.radius_m
    length = float(np.linalg.norm(end - start))
    ball = 2.0 / 3.0 * math.pi * radius**3
    sphere = {"radius": repr(radius)}
    found = [(rigid(np.eye(3), point), ET.Element("sphere", sphere), ball) for point in (start, end)]
    if length > 0.0:
        size = {"radius": repr(radius), "length": repr(length)}
        place = rigid(_z_along((end - start) / length), (start + end) / 2.0)
        found.append((place, ET.Element("cylinder", size), math.pi * radius**2 * length))
    return found


def _inertial(mass_kg: float, shapes: list[tuple[Array, ET.Element, float]]) -> ET.Element:
    """The link's mass spread over its shapes by volume, each taken as a ball: the masses are guesses anyway."""
    volumes = np.array([volume for *_, volume in shapes] or [1.0])
    centres = np.array([place[:3, 3] for place, *_ in shapes] or [np.zeros(3)])
    shares = mass_kg * volumes / volumes.sum()
    centre = (shares[:, None] * centres).sum(axis=0) / mass_kg
    inertia = np.zeros((3, 3))
    for share, volume, at in zip(shares, volumes, centres - centre, strict=True):
        radius_sq = (3.0 * volume / (4.0 * math.pi)) ** (2.0 / 3.0)
        inertia += share * ((0.4 * radius_sq + at @ at) * np.eye(3) - np.outer(at, at))
    return _mass(mass_kg, centre, inertia)


def _box_link(name: str, mass_kg: float, size: Array, centre: list[float]) -> ET.Element:
    element = ET.Element("link", name=name)
    squares = size**2
    element.append(_mass(mass_kg, np.array(centre), np.diag(mass_kg / 12.0 * (squares.sum() - squares))))
    for kind in ("visual", "collision"):
        shape = ET.SubElement(element, kind)
        shape.append(_origin(rigid(np.eye(3), centre)))
        ET.SubElement(ET.SubElement(shape, "geometry"), "box", size=_numbers(size))
    return element


def _mass(mass_kg: float, centre: Array, inertia: Array) -> ET.Element:
    inertial = ET.Element("inertial")
    ET.SubElement(inertial, "origin", xyz=_numbers(centre), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=repr(mass_kg))
    axes = "xyz"
    entries = {f"i{axes[i]}{axes[j]}": repr(float(inertia[i, j])) for i in range(3) for j in range(i, 3)}
    ET.SubElement(inertial, "inertia", entries)
    return inertial


def _tie(name: str, kind: str, parent: str, child: str, parent_from_child: Array) -> ET.Element:
    element = ET.Element("joint", name=name, type=kind)
    element.append(_origin(parent_from_child))
    ET.SubElement(element, "parent", link=parent)
    ET.SubElement(element, "child", link=child)
    return element


def _limit(element: ET.Element, lower: float, upper: float, speed: float) -> None:
    values = {"lower": repr(lower), "upper": repr(upper), "effort": repr(EFFORT_N_M), "velocity": repr(speed)}
    ET.SubElement(element, "limit", values)


def _origin(place: Array) -> ET.Element:
    return ET.Element("origin", xyz=_numbers(place[:3, 3]), rpy=_numbers(roll_pitch_yaw(place[:3, :3])))


def _rotation(rpy_deg: Iterable[float]) -> Array:
    """Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = (math.radians(angle) for angle in rpy_deg)
    rx = np.array([[1, 0, 0], [0, math.cos(roll), -math.sin(roll)], [0, math.sin(roll), math.cos(roll)]])
    ry = np.array([[math.cos(pitch), 0, math.sin(pitch)], [0, 1, 0], [-math.sin(pitch), 0, math.cos(pitch)]])
    rz = np.array([[math.cos(yaw), -math.sin(yaw), 0], [math.sin(yaw), math.cos(yaw), 0], [0, 0, 1]])
    return np.asarray(rz @ ry @ rx, np.float64)


def _z_along(direction: Array) -> Array:
    """A rotation whose third column is that unit vector."""
    aside = np.eye(3)[int(np.argmin(np.abs(direction)))]
    x = np.cross(aside, direction)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(direction, x), direction])


def _numbers(values: Iterable[float]) -> str:
    """Numbers as the shortest text that reads back as the same bits; no minus before a zero."""
    return " ".join(repr(float(value) + 0.0) for value in values)
