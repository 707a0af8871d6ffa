"""A robot as its file has it (docs/robots.md): metres, kilograms, and degrees where the key says so."""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.truth import Vector

Six = tuple[float, float, float, float, float, float]


class Opw(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """An ortho-parallel arm with a spherical wrist, by its lengths; theta = sign * q - offset."""

    a1_m: float
    a2_m: float
    b_m: float
    c1_m: float
    c2_m: float
    c3_m: float
    c4_m: float
    offsets_deg: Six
    signs: Six


class RobotJoint(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """A revolute joint; its place (parent link from joint) is None where the robot is told by `Opw`."""

    name: str
    limits_deg: tuple[float, float]
    speed_deg_per_s: float
    acceleration_deg_per_s2: float
    xyz_m: Vector | None = None
    rpy_deg: Vector | None = None
    axis: Vector | None = None


class Place(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A frame on another: fixed-axis angles as URDF has them."""

    xyz_m: Vector
    rpy_deg: Vector


class RobotCapsule(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """All within `radius_m` of a segment, in its link's frame."""

    from_m: Vector
    to_m: Vector
    radius_m: float


class RobotBox(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """A box in its link's frame."""

    centre_m: Vector
    size_m: Vector
    rpy_deg: Vector = (0.0, 0.0, 0.0)


class RobotLink(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """A link, its mass and the shapes that enclose it, in its joint's frame."""

    name: str
    mass_kg: float
    capsules: tuple[RobotCapsule, ...] = ()
    boxes: tuple[RobotBox, ...] = ()


class Gripper(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """A parallel-plate gripper in the flange's frame; the fingers move along y."""

    mass_kg: float
    body_size_m: Vector
    finger_size_m: Vector
    opening_m: tuple[float, float]
    tool_point_m: Vector


class RobotFile(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """All keys of a robot's file. Their values are checked by the core when an arm is made of them."""

    format: Literal["boxwright.robot"]
    version: Literal[1]
    name: str
    description: str = ""
    payload_kg: float | None = None
    repeatability_m: float | None = None
    ready_deg: tuple[float, ...]
    sources: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()
    may_touch: tuple[tuple[str, str], ...] = ()
    opw: Opw | None = None
    flange: Place | None = None
    joint: tuple[RobotJoint, ...]
    link: tuple[RobotLink, ...]
    gripper: Gripper


class BeyondUrdf(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True, omit_defaults=True):
    """What URDF cannot tell of a robot and our own element in it may; keys as `RobotFile`'s, None where not told."""

    ready_deg: tuple[float, ...] | None = None
    accelerations_deg_per_s2: tuple[float, ...] | None = None
    payload_kg: float | None = None
    repeatability_m: float | None = None
    sources: tuple[str, ...] = ()
    assumptions: tuple[str, ...] = ()
    may_touch: tuple[tuple[str, str], ...] | None = None
    opw: Opw | None = None
    gripper: Gripper | None = None
