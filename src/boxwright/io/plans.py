"""plan.json, trajectory.csv and camera poses in and out (docs/formats.md)."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from os import PathLike

from boxwright.io.decoding import load_json, save_json
from boxwright.types import Plan, Pose
from boxwright.types.posed import FARTHEST_M

Sample = tuple[float, tuple[float, ...]]


def load_plan(path: str | PathLike[str]) -> Plan:
    """Read a plan.json: metres, radians, seconds, the robot's base frame. Keys of later versions are ignored.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no usable plan.
    """
    return load_json(path, Plan)


def save_plan(plan: Plan, path: str | PathLike[str]) -> None:
    """Write a plan.json; equal plans give equal bytes. Raises OSError when it cannot be written."""
    save_json(plan, path)


def load_pose(path: str | PathLike[str]) -> Pose:
    """Read a pose: {"position" (m), "orientation" (x, y, z, w)}; as `--camera-pose` it is base_from_input.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no pose, or one that is
    farther off than any robot stands: told in millimetres.
    """
    pose = load_json(path, Pose)
    far = [value for value in pose.position if abs(value) > FARTHEST_M]
    if far:
        raise ValueError(
            f"{path}: position: holds {far[0]:.4g}; it is in metres, not millimetres: {FARTHEST_M:.0f} at the most"
        )
    return pose


def save_pose(pose: Pose, path: str | PathLike[str]) -> None:
    """Write a pose. Raises OSError when it cannot be written."""
    save_json(pose, path)


def samples(plan: Plan) -> Iterator[Sample]:
    """Time (s) and joint positions (rad) of every sample; the one that two segments share stands once."""
    last_s = None
    for segment in plan.segments:
        for time_s, row in zip(segment.times, segment.positions, strict=True):
            if time_s != last_s:
                yield time_s, row
            last_s = time_s


def save_trajectory(plan: Plan, path: str | PathLike[str]) -> None:
    """Write a trajectory.csv: `time_s,<joint>_rad,...`, one row a sample, numbers that read back the same.

    Raises OSError when it cannot be written.
    """
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["time_s", *(f"{name}_rad" for name in plan.joint_names)])
        writer.writerows([repr(time_s), *map(repr, row)] for time_s, row in samples(plan))


def load_trajectory(path: str | PathLike[str]) -> tuple[tuple[str, ...], list[Sample]]:
    """Read a trajectory.csv: the joints' names, and time (s) with positions (rad) of each sample.

    Raises OSError when the file cannot be read, ValueError naming file and line when it is none.
    """
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    header = rows[0] if rows else []
    if header[:1] != ["time_s"] or not all(name.endswith("_rad") for name in header[1:]) or len(header) < 2:
        raise ValueError(f"{path}: line 1: is no header; it must be time_s,<joint>_rad,...")
    found = []
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(header):
            raise ValueError(f"{path}: line {number}: holds {len(row)} values; the header has {len(header)}")
        try:
            time_s, *positions = map(float, row)
        except ValueError as error:
            raise ValueError(f"{path}: line {number}: {error}; it must hold numbers") from error
        found.append((time_s, tuple(positions)))
    return tuple(name.removesuffix("_rad") for name in header[1:]), found
