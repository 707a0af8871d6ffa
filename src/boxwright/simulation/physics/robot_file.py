"""A robot's file as physics takes it (docs/robots.md): planning works out by itself where its joints are."""

from __future__ import annotations

import tomllib
from importlib import resources
from os import PathLike
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.poses import rotation, translation
from boxwright.types import Opw, RobotFile, RobotJoint
from boxwright.types.truth import Vector

Array = NDArray[np.float64]

Mount = tuple[Array, Array]
"""Of a joint: parent_link_from_link (4, 4) where it is at zero, and its axis (3,) in the link's frame."""


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


def mounts(robot: RobotFile) -> list[Mount]:
    """Where each joint is on the link before. Raises ValueError when links do not match joints, or one is nowhere."""
    if len(robot.link) != len(robot.joint) + 1:
        raise ValueError(f"robot {robot.name} has {len(robot.link)} links; it has a base and one for each joint")
    if robot.opw is not None:
        return _ortho_parallel_mounts(robot.opw)
    return [_mount(robot.name, joint) for joint in robot.joint]


def last_link_from_flange(robot: RobotFile) -> Array:
    """(4, 4)."""
    if robot.opw is not None:
        return translation([0.0, 0.0, robot.opw.c4_m])
    return np.eye(4) if robot.flange is None else turned(robot.flange.xyz_m, robot.flange.rpy_deg)


def turned(xyz_m: Vector, rpy_deg: Vector) -> Array:
    """A pose (4, 4) from URDF's xyz and rpy: R = Rz(yaw) Ry(pitch) Rx(roll)."""
    roll, pitch, yaw = np.radians(rpy_deg)
    turn = rotation([0, 0, 1], yaw) @ rotation([0, 1, 0], pitch) @ rotation([1, 0, 0], roll)
    return translation(xyz_m) @ turn


def _mount(robot: str, joint: RobotJoint) -> Mount:
    if joint.xyz_m is None or joint.axis is None:
        raise ValueError(f"robot {robot}: {joint.name} has no xyz_m or no axis; without [opw] each joint has both")
    return turned(joint.xyz_m, joint.rpy_deg or (0.0, 0.0, 0.0)), np.array(joint.axis) / np.linalg.norm(joint.axis)


def _ortho_parallel_mounts(arm: Opw) -> list[Mount]:
    """M. Brandstoetter, A. Angerer, M. Hofbaur (2014), as docs/robots.md tells it."""
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
