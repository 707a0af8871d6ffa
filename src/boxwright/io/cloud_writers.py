"""Clouds to files: binary PCD and binary PLY."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray


def write_pcd(
    path: str | os.PathLike[str],
    points: ArrayLike,
    *,
    width: int,
    height: int,
    colors: ArrayLike | None = None,
    labels: ArrayLike | None = None,
    viewpoint: Sequence[float] | None = None,
) -> None:
    """Write a binary PCD v0.7 with the fields x y z, then rgb (U4, 0x00RRGGBB) and label (U4) where they are given.

    `points` (N, 3) metres in the input's frame, N = width * height, point v * width + u is pixel (u, v); `colors` (N,3)
    uint8; `labels` (N,) non-negative; `viewpoint` x, y, z of the sensor, metres, in the points' frame (None: 0, 0, 0,
    which an unorganized cloud's reader ignores). Same input, same bytes.

    Raises ValueError when shapes do not fit, OSError when the file cannot be written.
    """
    records = _records(points, width * height, colors, labels)
    names = records.dtype.names or ()
    x, y, z = (float(c) for c in (viewpoint if viewpoint is not None else (0.0, 0.0, 0.0)))
    header = "\n".join(
        (
            "# .PCD v0.7 - Point Cloud Data file format",
            "VERSION 0.7",
            "FIELDS " + " ".join(names),
            "SIZE " + " ".join("4" for _ in names),
            "TYPE " + " ".join("F" if name in "xyz" else "U" for name in names),
            "COUNT " + " ".join("1" for _ in names),
            f"WIDTH {width}",
            f"HEIGHT {height}",
            f"VIEWPOINT {x:.9g} {y:.9g} {z:.9g} 1 0 0 0",
            f"POINTS {width * height}",
            "DATA binary\n",
        )
    )
    with Path(path).open("wb") as file:
        file.write(header.encode("ascii"))
        records.tofile(file)


def write_ply(
    path: str | os.PathLike[str], points: ArrayLike, *, colors: ArrayLike | None = None, labels: ArrayLike | None = None
) -> None:
    """Write a binary little-endian PLY: vertex x y z (float), then red green blue (uchar) and label (uint) if given.

    `points` (N, 3) metres; `colors` (N, 3) uint8; `labels` (N,) non-negative. A PLY keeps neither image grid nor
    viewpoint. Raises ValueError when shapes do not fit, OSError when the file cannot be written.
    """
    xyz = np.asarray(points)
    records = _records(xyz, len(xyz), None, labels)
    layout = [("x", "<f4", "float"), ("y", "<f4", "float"), ("z", "<f4", "float")]
    values: dict[str, NDArray[np.generic]] = {name: records[name] for name in records.dtype.names or ()}
    if colors is not None:
        rgb = _rgb(colors, len(xyz))
        values |= {"red": rgb[:, 0], "green": rgb[:, 1], "blue": rgb[:, 2]}
        layout += [(name, "u1", "uchar") for name in ("red", "green", "blue")]
    if labels is not None:
        layout.append(("label", "<u4", "uint"))
    vertices = np.empty(len(xyz), dtype=np.dtype([(name, code) for name, code, _ in layout]))
    for name, _, _ in layout:
        vertices[name] = values[name]
    properties = "".join(f"property {ply_type} {name}\n" for name, _, ply_type in layout)
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(xyz)}\n{properties}end_header\n"
    with Path(path).open("wb") as file:
        file.write(header.encode("ascii"))
        vertices.tofile(file)


def _records(points: ArrayLike, count: int, colors: ArrayLike | None, labels: ArrayLike | None) -> NDArray[np.void]:
    """One little-endian record of 4-byte fields for each point."""
    xyz = np.asarray(points)
    if xyz.shape != (count, 3):
        raise ValueError(f"points: shape is {xyz.shape}; must be ({count}, 3), width * height points")
    fields = [("x", "<f4"), ("y", "<f4"), ("z", "<f4")]
    columns: list[NDArray[np.generic]] = [xyz[:, 0], xyz[:, 1], xyz[:, 2]]
    if colors is not None:
        rgb = _rgb(colors, count).astype(np.uint32)
        fields.append(("rgb", "<u4"))
        columns.append((rgb[:, 0] << 16) | (rgb[:, 1] << 8) | rgb[:, 2])
    if labels is not None:
        fields.append(("label", "<u4"))
        columns.append(_labels(labels, count))
    records = np.empty(count, dtype=np.dtype(fields))
    for (name, _), column in zip(fields, columns, strict=True):
        records[name] = column
    return records


def _rgb(colors: ArrayLike, count: int) -> NDArray[np.uint8]:
    rgb = np.asarray(colors)
    if rgb.shape != (count, 3) or rgb.dtype != np.uint8:
        raise ValueError(f"colors: are {rgb.dtype} {rgb.shape}; must be uint8 ({count}, 3)")
    return rgb


def _labels(labels: ArrayLike, count: int) -> NDArray[np.integer]:
    values = np.asarray(labels)
    if values.shape != (count,) or not np.issubdtype(values.dtype, np.integer):
        raise ValueError(f"labels: are {values.dtype} {values.shape}; must be integers ({count},)")
    if count and (values.min() < 0 or values.max() > np.iinfo(np.uint32).max):
        raise ValueError(f"labels: reach from {values.min()} to {values.max()}; must fit an unsigned 32-bit integer")
    return values
