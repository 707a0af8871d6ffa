"""A robot from a URDF file: one chain of 6 or 7 revolute joints, limits, and collision shapes that are primitives.

URDF knows no accelerations, no gripper of ours, no posture to wait in, nor which shapes are drawn too thick. Where no
element of our own tells them they are guessed, and the guesses stand in `assumptions`; `boxwright robots FILE.urdf
--toml OUT.toml` writes them down to be set right.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import msgspec

from boxwright.robots.urdf_beyond import TAG, beyond_of, with_closed_form
from boxwright.robots.urdf_chain import Chain, chain_of, degrees, numbers, place, vector
from boxwright.robots.urdf_guess import CLEARANCE_M, OFTEN, POSTURES, free_ready_deg, middle_deg, touching_pairs
from boxwright.robots.urdf_shapes import link_of
from boxwright.types import BeyondUrdf, Gripper, Place, RobotFile, RobotJoint

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

DEGREE_DIGITS = 12
"""Digits that are kept behind the point: what radians round off is beyond."""


def robot_of_urdf(text: str, name: str) -> RobotFile:
    """The robot of a URDF text, with what a `<boxwright>` element in it tells, and guesses for what it does not.

    Raises ValueError in one line: no chain of 6 or 7 revolute joints, a missing limit, a mesh, a wrong key.
    """
    try:
        root = ET.fromstring(text)
    except ET.ParseError as error:
        raise ValueError(f"is no XML: {error}") from None
    chain, told = chain_of(root), beyond_of(root)
    joints = _with_accelerations(tuple(_joint(element) for element in chain.joints), told)
    file = RobotFile(
        format="boxwright.robot",
        version=1,
        name=name,
        description=f"from the URDF of {root.get('name', name)}",
        payload_kg=told.payload_kg,
        repeatability_m=told.repeatability_m,
        ready_deg=(),
        sources=told.sources,
        assumptions=told.assumptions + _assumed(told),
        flange=_flange(chain),
        joint=joints,
        link=tuple(link_of(element) for element in chain.links),
        gripper=told.gripper or GRIPPER,
    )
    file = msgspec.structs.replace(file, ready_deg=middle_deg(file))
    if told.opw is not None:
        file = with_closed_form(file, told.opw)
    return _with_ready(_with_may_touch(file, told), told)


def _assumed(told: BeyondUrdf) -> tuple[str, ...]:
    guesses = (
        (
            told.accelerations_deg_per_s2,
            f"accelerations: top speed within {SECONDS_TO_TOP_SPEED} s; URDF tells none",
        ),
        (told.gripper, "gripper: the shipped robots'; URDF was read up to the chain's last link"),
    )
    return tuple(line for value, line in guesses if value is None)


def _with_accelerations(joints: tuple[RobotJoint, ...], told: BeyondUrdf) -> tuple[RobotJoint, ...]:
    values = told.accelerations_deg_per_s2
    if values is None:
        return joints
    _require_count("accelerations_deg_per_s2", values, joints)
    pairs = zip(joints, values, strict=True)
    return tuple(msgspec.structs.replace(joint, acceleration_deg_per_s2=value) for joint, value in pairs)


def _with_may_touch(file: RobotFile, told: BeyondUrdf) -> RobotFile:
    if told.may_touch is not None:
        return msgspec.structs.replace(file, may_touch=told.may_touch)
    pairs = touching_pairs(file)
    if not pairs:
        return file
    line = (
        f"may_touch: {', '.join(' and '.join(pair) for pair in pairs)}, not held against each other since they come "
        f"within {1000.0 * CLEARANCE_M:.0f} mm in {100.0 * OFTEN:.0f} % or more of {POSTURES} postures"
    )
    return msgspec.structs.replace(file, may_touch=pairs, assumptions=(*file.assumptions, line))


def _with_ready(file: RobotFile, told: BeyondUrdf) -> RobotFile:
    if told.ready_deg is not None:
        _require_count("ready_deg", told.ready_deg, file.joint)
        return msgspec.structs.replace(file, ready_deg=told.ready_deg)
    ready_deg = free_ready_deg(file)
    if ready_deg is None:
        line = f"ready_deg: the middle of the limits, where the arm runs into itself, as in each of {POSTURES} postures"
        return msgspec.structs.replace(file, assumptions=(*file.assumptions, line))
    line = (
        "ready_deg: the posture nearest to the middle of the limits, of a fixed list, that is clear of the arm itself"
    )
    return msgspec.structs.replace(file, ready_deg=ready_deg, assumptions=(*file.assumptions, line))


def _require_count(key: str, values: tuple[float, ...], joints: tuple[RobotJoint, ...]) -> None:
    if len(values) != len(joints):
        raise ValueError(f"<{TAG}>: {key} has {len(values)} values; one for each of {len(joints)} joints")


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
        angle_rad = numbers(told, 1, f"joint {name}: limit {key}")[0]
        values[key] = round(math.degrees(angle_rad), DEGREE_DIGITS)
    axis = element.find("axis")
    xyz_m, rpy_rad = place(element, f"joint {name}")
    speed_deg_per_s = values["velocity"]
    direction = "1 0 0" if axis is None else axis.get("xyz", "1 0 0")
    return RobotJoint(
        name=name,
        limits_deg=(values["lower"], values["upper"]),
        speed_deg_per_s=speed_deg_per_s,
        acceleration_deg_per_s2=speed_deg_per_s / SECONDS_TO_TOP_SPEED,
        xyz_m=xyz_m,
        rpy_deg=degrees(rpy_rad),
        axis=vector(numbers(direction, 3, f"joint {name}: axis")),
    )


def _flange(chain: Chain) -> Place:
    xyz_m, rpy_rad = chain.last_link_from_flange
    return Place(xyz_m=xyz_m, rpy_deg=degrees(rpy_rad))
