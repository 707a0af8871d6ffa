"""What became of one problem by one way and one class of creases, as one file, so that a set can be run in pieces."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeVar

import msgspec

WAYS = ("layered", "paper", "seen", "looking")
"""Planners on true models; ours on models inferred from a simulated frame, at one go and with looks between flaps."""
CREASES = ("pre_broken", "ordinary", "stiff")

Made = TypeVar("Made", bound=msgspec.Struct)


class FlapRecord(msgspec.Struct, frozen=True):
    """An open flap: its status, whether it was at 0 while it was pushed, and closed at the end of all."""

    name: str
    farthest: bool
    status: str
    reached: bool
    held: bool
    reason: str | None = None
    """Why there is no plan, in the planner's words; None where there is one."""


class Record(msgspec.Struct, frozen=True):
    """One problem by one way with one class of creases."""

    number: int
    category: str
    way: str
    crease: str
    flaps: tuple[FlapRecord, ...]
    planning_s: float
    """Of the processor: other work on the machine does not count."""
    failure: str | None
    """Why the run proves nothing."""
    most_force_n: float
    slid_m: float
    unwanted: int
    """Pairs that touched and should not have."""
    stopped: str | None = None
    """Where the arm was stopped, since it pressed too hard; None where it was not."""


class Limits(msgspec.Struct, frozen=True):
    """What can be asked of a problem's open flaps at all, each by itself, the others where they stand."""

    number: int
    feasible: dict[str, bool]
    """Brute force finds a motion; only of flaps that no way planned, since a plan proves it too."""
    bearable: dict[str, dict[str, bool]]
    """By class of creases: the box stands being pushed so hard."""


def kept(path: Path, kind: type[Made], make: Callable[[], Made]) -> Made:
    """What the file holds; made and written first where there is none."""
    if not path.is_file():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(msgspec.json.encode(make()))
    return msgspec.json.decode(path.read_bytes(), type=kind)


def record_path(folder: Path, number: int, way: str, crease: str) -> Path:
    """Where a record is."""
    return folder / f"{number:03d}_{way}_{crease}.json"


def limits_path(folder: Path, number: int) -> Path:
    """Where the limits of a problem are."""
    return folder / f"{number:03d}_limits.json"


def read_records(folder: Path, numbers: Sequence[int], ways: Sequence[str], creases: Sequence[str]) -> list[Record]:
    """Those of the folder."""
    paths = [record_path(folder, number, way, crease) for number in numbers for way in ways for crease in creases]
    return [msgspec.json.decode(path.read_bytes(), type=Record) for path in paths if path.is_file()]
