"""A robot's file as physics reads it (docs/robots.md). Planning reads the same file by itself: no mistake is shared."""

from __future__ import annotations

import tomllib
from importlib import resources
from os import PathLike
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.poses import rotation, translation
from boxwright.types.truth import Vector

Array = NDArray[np.float64]


class Capsule(msgspec.Struct, frozen=True, kw_only=True):
    """A rounded rod between two points of the link's frame, metres."""

    start_m: Vector = msgspec.field(name="from_m")
    end_m: Vector = msgspec.field(name="to_m")
    radius_m: float


class Cuboid(msgspec.Struct, frozen=True, kw_only=True):
    """A box in the link's frame: its centre and edges, metres, turned about fixed axes as URDF's rpy."""

    centre_m: Vector
    size_m: Vector
    rpy_deg: Vector = (0.0, 0.0, 0.0)


class Link(msgspec.Struct, frozen=True, kw_only=True):
    """A link: its mass is spread evenly over its shapes."""

    name: str
    mass_kg: float
    capsules: tuple[Capsule, ...] = ()
    boxes: tuple[Cuboid, ...] = ()


class JointFile(msgspec.Struct, frozen=True, kw_only=True):
    """A joint; where it is stands here only where the arm is not ortho-parallel."""

    name: str
    limits_deg: tuple[float, float]
    speed_deg_per_s: float
    acceleration_deg_per_s2: float
    xyz_m: Vector | None = None
    rpy_deg: Vector = (0.0, 0.0, 0.0)
    axis: Vector | None = None


class Flange(msgspec.Struct, frozen=True, kw_only=True):
    """last_link_from_flange of an arm that is not ortho-parallel."""

    xyz_m: Vector
    rpy_deg: Vector = (0.0, 0.0, 0.0)


class Gripper(msgspec.Struct, frozen=True, kw_only=True):
    """A parallel-plate gripper on the flange, sizes x, y, z in the flange's frame, metres."""

    mass_kg: float
    body_size_m: Vector
    finger_size_m: Vector
    opening_m: tuple[float, float]
    tool_point_m: Vector


class OrthoParallel(msgspec.Struct, frozen=True, kw_only=True):
    """The seven lengths of an ortho-parallel arm with a spherical wrist (Brandstoetter, Angerer, Hofbaur, 2014)."""

    a1_m: float
    a2_m: float
    b_m: float
    c1_m: float
    c2_m: float
    c3_m: float
    c4_m: float
    offsets_deg: tuple[float, ...]
    signs: tuple[int, ...]


class RobotFile(msgspec.Struct, frozen=True, kw_only=True):
    """What physics needs of a robot's file."""

    format: str
    version: int
    name: str
    ready_deg: tuple[float, ...]
    joints: tuple[JointFile, ...] = msgspec.field(name="joint")
    links: tuple[Link, ...] = msgspec.field(name="link")
    gripper: Gripper
    opw: OrthoParallel | None = None
    flange: Flange | None = None
    may_touch: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if (self.format, self.version) != ("boxwright.robot", 1):
            raise ValueError(f"format is {self.format!r}, version {self.version}; must be 'boxwright.robot', 1")
        if len(self.links) != len(self.joints) + 1:
            raise ValueError(f"there are {len(self.links)} links; there must be a base and one for each joint")
        if self.opw is None and any(joint.xyz_m is None or joint.axis is None for joint in self.joints):
            raise ValueError("a joint has no xyz_m or no axis; without [opw] each has both")

    def mounts(self) -> list[tuple[Array, Array]]:
        """For each joint parent_link_from_link (4, 4) where it is at zero, and its axis (3,) in the link's frame."""
        return _placed_mounts(self.joints) if self.opw is None else _ortho_parallel_mounts(self.opw)

    def last_link_from_flange(self) -> Array:
        """(4, 4)."""
        if self.opw is not None:
            return translation([0.0, 0.0, self.opw.c4_m])
        return np.eye(4) if self.flange is None else turned(self.flange.xyz_m, self.flange.rpy_deg)


def load_robot(name_or_path: str | PathLike[str]) -> RobotFile:
    """A shipped robot by its name, or a file by its path (it ends in .toml).

    Raises OSError when the file cannot be read, ValueError naming file and key when it is no robot, or the robots that
    are shipped when the name is none of theirs.
    """
    path = Path(name_or_path)
    if path.suffix != ".toml":
        shipped = resources.files("boxwright").joinpath("robots", "data")
        names = sorted(entry.name.removesuffix(".toml") for entry in shipped.iterdir() if entry.name.endswith(".toml"))
        if str(name_or_path) not in names:
            raise ValueError(f"robot is {str(name_or_path)!r}; must be one of {', '.join(names)}, or a .toml file")
        text = shipped.joinpath(f"{name_or_path}.toml").read_text(encoding="utf-8")
    else:
        text = path.read_text(encoding="utf-8")
    try:
        return msgspec.convert(tomllib.loads(text), RobotFile)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError, ValueError) as error:
        raise ValueError(f"{name_or_path}: {error}") from error


def turned(xyz_m: Vector, rpy_deg: Vector) -> Array:
    """A pose (4, 4) from URDF's xyz and rpy: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = np.radians(rpy_deg)
    turn = rotation([0, 0, 1], yaw) @ rotation([0, 1, 0], pitch) @ rotation([1, 0, 0], roll)
    return translation(xyz_m) @ turn


def _placed_mounts(joints: tuple[JointFile, ...]) -> list[tuple[Array, Array]]:
    return [
        (turned(joint.xyz_m, joint.rpy_deg), np.array(joint.axis) / np.linalg.norm(joint.axis))
        for joint in joints
        if joint.xyz_m is not None and joint.axis is not None
    ]


def _ortho_parallel_mounts(arm: OrthoParallel) -> list[tuple[Array, Array]]:
    origins_m = (
        (0.0, 0.0, 0.0),
        (arm.a1_m, 0.0, arm.c1_m),
        (0.0, 0.0, arm.c2_m),
        (arm.a2_m, arm.b_m, 0.0),
        (0.0, 0.0, arm.c3_m),
        (0.0, 0.0, 0.0),
    )
    axes = np.eye(3)[[2, 1, 1, 2, 1, 2]]
    return [
        (translation(origin) @ rotation(axis, -np.radians(offset_deg)), sign * axis)
        for origin, axis, offset_deg, sign in zip(origins_m, axes, arm.offsets_deg, arm.signs, strict=True)
    ]
