"""What URDF cannot tell of a robot, in an element of our own in it: `<boxwright>`, its text TOML (docs/robots.md).

Other readers of URDF pass over elements that they do not know.
"""

from __future__ import annotations

import tomllib
import xml.etree.ElementTree as ET

import msgspec
import numpy as np

from boxwright import _core
from boxwright.robots.finite import require_finite_numbers
from boxwright.robots.robot_toml import toml_text
from boxwright.types import BeyondUrdf, Opw, RobotFile

TAG = "boxwright"

SAME = 1e-6
"""Joints are where a closed form has them when every entry of their places is, metres and shares of unit vectors."""


def beyond_of(root: ET.Element) -> BeyondUrdf:
    """What our element in a URDF tells; nothing where there is none. Raises ValueError naming the key that is wrong."""
    element = root.find(TAG)
    if element is None:
        return BeyondUrdf()
    try:
        told = msgspec.convert(tomllib.loads(element.text or ""), BeyondUrdf)
        require_finite_numbers(told)
    except ValueError as error:
        raise ValueError(f"<{TAG}>: {error}") from None
    return told


def beyond_element(file: RobotFile) -> ET.Element:
    """The element that tells what a robot's URDF does not."""
    beyond = BeyondUrdf(
        ready_deg=file.ready_deg,
        accelerations_deg_per_s2=tuple(joint.acceleration_deg_per_s2 for joint in file.joint),
        payload_kg=file.payload_kg,
        repeatability_m=file.repeatability_m,
        sources=file.sources,
        assumptions=file.assumptions,
        may_touch=file.may_touch,
        opw=file.opw,
        gripper=file.gripper,
    )
    element = ET.Element(TAG)
    element.text, element.tail = f"\n{toml_text(beyond)}", "\n"
    return element


def with_closed_form(file: RobotFile, opw: Opw) -> RobotFile:
    """The robot told by its closed form instead of its joints' places, which must be the same.

    Raises ValueError where they are not.
    """
    joints = tuple(msgspec.structs.replace(joint, xyz_m=None, rpy_deg=None, axis=None) for joint in file.joint)
    closed = msgspec.structs.replace(file, opw=opw, flange=None, joint=joints)
    told, made = (_core.Arm(toml_text(one)) for one in (file, closed))
    for k, joint in enumerate(file.joint):
        off = np.abs(told.parent_from_joint[k] - made.parent_from_joint[k]).max()
        if max(off, np.abs(told.axes[k] - made.axes[k]).max()) > SAME:
            raise ValueError(
                f"<{TAG}>: opw puts joint {joint.name} elsewhere than its origin; set one right, or leave opw out"
            )
    if np.abs(told.last_link_from_flange - made.last_link_from_flange).max() > SAME:
        raise ValueError(f"<{TAG}>: opw puts the flange elsewhere than its joint does; set one right, or leave opw out")
    return closed
