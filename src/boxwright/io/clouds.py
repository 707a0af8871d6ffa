"""Clouds in and out of files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from boxwright import _core
from boxwright.io.cloud_writers import write_pcd, write_ply
from boxwright.io.intrinsics import read_intrinsics
from boxwright.types.checks import require_finite
from boxwright.types.cloud import Cloud
from boxwright.types.intrinsics import Intrinsics
from boxwright.types.truth import Vector

__all__ = ["SUFFIXES", "read_cloud", "write_pcd", "write_ply"]

SUFFIXES = (".pcd", ".ply", ".npy", ".png")
"""Suffixes of files that `read_cloud` reads."""


def read_cloud(
    path: str | os.PathLike[str],
    *,
    unit: Literal["m", "mm"] = "m",
    frame: Literal["optical", "opengl"] = "optical",
    viewpoint: Sequence[float] | None = None,
    intrinsics: Intrinsics | str | os.PathLike[str] | None = None,
    depth_unit_m: float | None = None,
    depth_decode: Literal["none", "rotate3"] = "none",
) -> Cloud:
    """Read a cloud, in metres, in the file's own frame. The suffix decides: .pcd, .ply, .npy, or .png (a depth image).

    PCD: versions .5 to .7, ascii, binary, binary_compressed. PLY: ascii, both byte orders. NPY: (N, 3) unorganized or
    (rows, columns, 3) organized, float32 or float64. PNG: 16 bits, grey, with `intrinsics` (a value, or a file for
    `boxwright.io.intrinsics.read_intrinsics`); it becomes an organized cloud in the camera's optical frame.

    - `unit`: of the file's coordinates. A cloud that cannot be in that unit is refused.
    - `frame`: "opengl" says that an organized cloud's camera looks along -z. Coordinates stay as they are; without
      it such a cloud is refused.
    - `viewpoint`: x, y, z of the sensor, metres, file's frame; goes before the file's own. An unorganized cloud has
      none unless it is given here.
    - `depth_unit_m`: metres of one step of a depth image; goes before what the intrinsics say.
    - `depth_decode`: "rotate3" for images whose bits are rotated by three (RealSense F200).

    Raises ValueError with one line (file, place, problem, mend) when the file or an option does not fit, OSError when a
    file cannot be read.
    """
    name = os.fspath(path)
    suffix = Path(name).suffix.lower()
    place = _viewpoint(viewpoint)
    if suffix == ".png":
        camera, step_m = _depth_camera(name, intrinsics, depth_unit_m)
        pinhole = (camera.fx, camera.fy, camera.cx, camera.cy)
        found = _core.read_depth_png(
            name, pinhole, camera.size, camera.distortion, step_m, depth_decode, unit, frame, place
        )
    elif suffix in SUFFIXES:
        _refuse_depth_options(name, intrinsics, depth_unit_m, depth_decode)
        found = _core.read_cloud(name, suffix[1:], unit, frame, place)
    else:
        raise ValueError(f"{name}: the suffix {suffix!r} is no cloud's; must be one of {', '.join(SUFFIXES)}")
    return Cloud(
        points=found.points,
        width=found.width,
        height=found.height,
        viewpoint=found.viewpoint,
        colors=found.colors,
        labels=found.labels,
        path=name,
    )


def _viewpoint(values: Sequence[float] | None) -> Vector | None:
    if values is None:
        return None
    if len(values) != 3:
        raise ValueError(f"viewpoint: has {len(values)} values; must be x, y, z")
    x, y, z = (float(value) for value in values)
    require_finite("viewpoint", (x, y, z))
    return (x, y, z)


def _depth_camera(
    name: str, intrinsics: Intrinsics | str | os.PathLike[str] | None, depth_unit_m: float | None
) -> tuple[Intrinsics, float]:
    """The depth image's camera and its depth unit."""
    if intrinsics is None:
        raise ValueError(f"{name}: a depth image needs its camera; say --intrinsics FILE")
    camera = intrinsics if isinstance(intrinsics, Intrinsics) else read_intrinsics(intrinsics)
    step_m = camera.depth_unit_m if depth_unit_m is None else depth_unit_m
    if step_m is None:
        raise ValueError(f"{name}: the intrinsics do not say the depth unit; say --depth-unit-m METRES (0.001 for mm)")
    return camera, step_m


def _refuse_depth_options(name: str, intrinsics: object, depth_unit_m: float | None, depth_decode: str) -> None:
    """Options without an effect are mistakes."""
    given = {"--intrinsics": intrinsics, "--depth-unit-m": depth_unit_m}
    wrong = [option for option, value in given.items() if value is not None]
    if depth_decode != "none":
        wrong.append("--depth-decode")
    if wrong:
        raise ValueError(f"{name}: {', '.join(wrong)} is for depth images (.png); leave it out")
