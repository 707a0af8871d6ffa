"""Robots as data (docs/robots.md)."""

from __future__ import annotations

from importlib import resources
from os import PathLike
from pathlib import Path


def robot_names() -> tuple[str, ...]:
    """Those that are shipped."""
    data = resources.files("boxwright").joinpath("robots", "data")
    return tuple(sorted(entry.name.removesuffix(".toml") for entry in data.iterdir() if entry.name.endswith(".toml")))


def robot_text(robot: str | PathLike[str]) -> str:
    """The text of a shipped robot's file, by its name, or of a robot's file (it ends in .toml).

    Raises OSError when the file cannot be read, ValueError naming the robots that are shipped.
    """
    if Path(robot).suffix == ".toml":
        return Path(robot).read_text(encoding="utf-8")
    if str(robot) not in robot_names():
        raise ValueError(f"robot is {str(robot)!r}; must be one of {', '.join(robot_names())}, or a .toml file")
    data = resources.files("boxwright").joinpath("robots", "data")
    return data.joinpath(f"{robot}.toml").read_text(encoding="utf-8")
