"""Where robots are found: those shipped, by name, or a user's own, by path (TOML or URDF)."""

from __future__ import annotations

import tomllib
from functools import lru_cache
from os import PathLike
from pathlib import Path

import msgspec

from boxwright.robots.finite import require_finite_numbers
from boxwright.robots.robot_toml import toml_text
from boxwright.robots.urdf_read import robot_of_urdf
from boxwright.types import RobotFile

_DATA = Path(__file__).parent / "data"
URDF_SUFFIX = ".urdf"


def robot_names() -> tuple[str, ...]:
    """Those that are shipped."""
    return tuple(sorted(path.stem for path in _DATA.glob("*.toml")))


def robot_text(robot: str | PathLike[str]) -> str:
    """The TOML text of a robot: shipped, by its name, or one's own, by its .toml or .urdf file.

    Raises OSError when the file cannot be read, ValueError naming what does not fit, or the robots that are shipped.
    """
    path = Path(robot)
    if path.suffix == URDF_SUFFIX:
        try:
            return _text_of_urdf(_read_text(path), path.stem)
        except ValueError as error:
            raise ValueError(f"{path}: {error}") from None
    if path.suffix == ".toml":
        return _read_text(path)
    if str(robot) not in robot_names():
        known = ", ".join(robot_names())
        raise ValueError(f"{robot}: no robot of that name; known are {known}, or name a .toml or .urdf file")
    return _read_text(_DATA / f"{robot}.toml")


def robot_file(robot: str | PathLike[str]) -> RobotFile:
    """A robot's file as a record. Raises as `robot_text` does, and ValueError naming a key that does not fit."""
    text = robot_text(robot)
    try:
        file = msgspec.convert(tomllib.loads(text), RobotFile)
        require_finite_numbers(file)
    except ValueError as error:
        raise ValueError(f"{robot}: {error}") from None
    return file


@lru_cache(maxsize=8)
def _text_of_urdf(urdf: str, name: str) -> str:
    """What a URDF does not tell takes a while to find, and one plan asks for its robot many times."""
    return toml_text(robot_of_urdf(urdf, name))


def _read_text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
