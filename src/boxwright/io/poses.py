"""Frames of one scene and their poses: TOML files (docs/formats.md)."""

from __future__ import annotations

import math
import os
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from boxwright.io.quaternions import rotation_of
from boxwright.types import PosedFile
from boxwright.types.checks import require_rigid

FORM = "a file of poses is [[frame]] tables with file and base_from_camera"
POSE_FORM = "4 rows of 4 numbers, metres, or {position_m = [x, y, z], orientation_xyzw = [x, y, z, w]}"
FRAME_KEYS = ("file", "base_from_camera")
POSE_KEYS = ("position_m", "orientation_xyzw")

ROUNDED = 1e-3
"""Poses are typed with few decimals: a rotation that is one within this is taken to be the nearest one."""


def read_poses(path: str | os.PathLike[str]) -> tuple[PosedFile, ...]:
    """The frames of a file of poses, in its order; files are told from its own folder.

    Raises OSError when it cannot be read; ValueError with file, place and mend where it is wrong: no frame, keys that
    are not known, a file that is not there or is listed twice, a pose that is no rigid motion or in millimetres.
    """
    path = Path(path)
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
    except tomllib.TOMLDecodeError as error:
        raise ValueError(f"{path}: {error}; {FORM}") from None
    for key in content:
        if key != "frame":
            raise ValueError(f"{path}: {key!r} is not known; {FORM}")
    tables = content.get("frame")
    if not isinstance(tables, list) or not tables:
        raise ValueError(f"{path}: holds no frame; {FORM}")
    frames: list[PosedFile] = []
    for number, table in enumerate(tables, start=1):
        try:
            frame = _frame(path, table)
            _refuse_twice(frame, frames)
        except ValueError as error:
            raise ValueError(f"{path}: frame {number}: {error}") from None
        frames.append(frame)
    return tuple(frames)


def write_poses(path: str | os.PathLike[str], frames: Iterable[PosedFile]) -> None:
    """Writes a file of poses; equal frames give equal bytes. Raises OSError when it cannot be written."""
    tables = []
    for frame in frames:
        rows = ",\n".join(f"  [{', '.join(repr(float(value)) for value in row)}]" for row in frame.base_from_camera)
        name = frame.file.as_posix().replace("\\", "\\\\").replace('"', '\\"')
        tables.append(f'[[frame]]\nfile = "{name}"\nbase_from_camera = [\n{rows},\n]\n')
    Path(path).write_text("\n".join(tables), encoding="utf-8")


def _frame(path: Path, table: object) -> PosedFile:
    if not isinstance(table, dict):
        raise ValueError(f"is {table!r}; {FORM}")
    for key in table:
        if key not in FRAME_KEYS:
            raise ValueError(f"{key!r} is not known; {_mend(key)}")
    for key in FRAME_KEYS:
        if key not in table:
            raise ValueError(f"{key} is missing; {FORM}")
    name = table["file"]
    if not isinstance(name, str) or not name:
        raise ValueError(f"file is {name!r}; must be the name of a cloud's file")
    file = path.parent / name
    if not file.is_file():
        raise ValueError(f"{name}: there is no such file; files are told from the folder of {path.name}")
    return PosedFile(file=file, base_from_camera=_pose(table["base_from_camera"]))


def _mend(key: str) -> str:
    if key == "camera_from_base":
        return "poses are told the other way round: base_from_camera, its inverse"
    if key.endswith("_from_camera"):
        return "poses of all frames are told in one fixed frame: base_from_camera"
    return FORM


def _pose(value: object) -> NDArray[np.float64]:
    """base_from_camera in either form."""
    if isinstance(value, dict):
        return _of_quaternion(value)
    is_matrix = isinstance(value, list) and len(value) == 4 and all(_are_numbers(row, 4) for row in value)
    if not is_matrix:
        raise ValueError(f"base_from_camera: is not a pose; must be {POSE_FORM}")
    matrix = np.array(value, dtype=np.float64)
    require_rigid("base_from_camera", matrix, ROUNDED)
    left, _, right = np.linalg.svd(matrix[:3, :3])
    return _motion(left @ right, matrix[:3, 3])


def _of_quaternion(value: dict[str, Any]) -> NDArray[np.float64]:
    if sorted(value) != sorted(POSE_KEYS):
        raise ValueError(f"base_from_camera: has the keys {', '.join(sorted(value)) or 'none'}; must be {POSE_FORM}")
    for key, count in zip(POSE_KEYS, (3, 4), strict=True):
        if not _are_numbers(value[key], count):
            raise ValueError(f"base_from_camera: {key} is {value[key]!r}; must be {count} numbers")
    x, y, z, w = value["orientation_xyzw"]
    length = math.hypot(x, y, z, w)
    if not abs(length - 1.0) <= ROUNDED:
        raise ValueError(
            f"base_from_camera: orientation_xyzw has length {length:.6g}; must be a unit quaternion x, y, z, w"
        )
    return _motion(rotation_of((x, y, z, w)), np.array(value["position_m"], dtype=np.float64))


def _motion(turn: NDArray[np.float64], position_m: NDArray[np.float64]) -> NDArray[np.float64]:
    out = np.eye(4)
    out[:3, :3], out[:3, 3] = turn, position_m
    return out


def _are_numbers(values: object, count: int) -> bool:
    if not isinstance(values, list) or len(values) != count:
        return False
    return all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)


def _refuse_twice(frame: PosedFile, before: list[PosedFile]) -> None:
    for number, other in enumerate(before, start=1):
        if other.file.resolve() == frame.file.resolve():
            raise ValueError(f"{frame.file.name} is frame {number} already; a frame is told once")
