"""Intrinsics of depth images: boxwright's JSON, ROS camera_info YAML, or the text of the APC vision toolbox."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from boxwright.io.decoding import load_json
from boxwright.types.intrinsics import Intrinsics

T = TypeVar("T")


class _Matrix(msgspec.Struct):
    """A matrix of a camera_info file, row by row."""

    data: list[float]


class _CameraInfo(msgspec.Struct):
    """What is used of a ROS camera_info file as camera_calibration and image_transport write it."""

    image_width: int
    image_height: int
    camera_matrix: _Matrix
    distortion_coefficients: _Matrix = msgspec.field(default_factory=lambda: _Matrix([]))
    distortion_model: str = "plumb_bob"


class _CameraInfoMessage(msgspec.Struct):
    """The message sensor_msgs/CameraInfo itself, as `ros2 topic echo` prints it."""

    width: int
    height: int
    k: list[float]
    d: list[float] = []
    distortion_model: str = "plumb_bob"


def read_intrinsics(path: str | os.PathLike[str]) -> Intrinsics:
    """Read intrinsics; the suffix decides the format: .json, .yaml or .yml (ROS camera_info), .txt (APC cam.info).

    Neither YAML nor text holds the depth unit: there `depth_unit_m` is None.

    Raises ValueError naming file and key when the content does not fit, OSError when the file cannot be read.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".json":
        return load_json(path, Intrinsics)
    readers: Mapping[str, Callable[[bytes], Intrinsics]] = {
        ".yaml": _from_yaml,
        ".yml": _from_yaml,
        ".txt": _from_text,
    }
    if suffix not in readers:
        known = ", ".join([".json", *readers])
        raise ValueError(f"{os.fspath(path)}: intrinsics cannot be read from {suffix!r}; must be {known}")
    try:
        return readers[suffix](Path(path).read_bytes())
    except ValueError as error:  # msgspec's and Unicode errors are among them
        raise ValueError(f"{os.fspath(path)}: {' '.join(str(error).split())}") from error


def _from_yaml(content: bytes) -> Intrinsics:
    import yaml  # only users of YAML pay for it

    try:
        values = yaml.safe_load(content)
    except yaml.YAMLError as error:
        raise ValueError(f"is no YAML: {error}") from error
    if isinstance(values, dict) and "camera_matrix" in values:
        info = _convert(values, _CameraInfo)
        return _pinhole(
            info.camera_matrix.data,
            (info.image_width, info.image_height),
            info.distortion_model,
            info.distortion_coefficients.data,
        )
    message = _convert(_lower_keys(values), _CameraInfoMessage)
    return _pinhole(message.k, (message.width, message.height), message.distortion_model, message.d)


def _convert(values: Any, kind: type[T]) -> T:
    return msgspec.convert(values, type=kind)


def _lower_keys(values: Any) -> Any:
    """ROS 1 prints K and D, ROS 2 k and d."""
    return {str(key).lower(): value for key, value in values.items()} if isinstance(values, dict) else values


def _pinhole(matrix: list[float], size: tuple[int, int], model: str, distortion: list[float]) -> Intrinsics:
    """From the matrix K, row by row."""
    if len(matrix) != 9:
        raise ValueError(f"the camera matrix has {len(matrix)} values; must be 9")
    return Intrinsics(
        fx=matrix[0],
        cx=matrix[2],
        fy=matrix[4],
        cy=matrix[5],
        width=size[0],
        height=size[1],
        distortion=_five(model, distortion),
    )


def _five(model: str, distortion: list[float]) -> tuple[float, float, float, float, float]:
    """k1, k2, p1, p2, k3 of plumb_bob, and of rational_polynomial where its further terms are 0."""
    if not any(distortion):
        return (0.0, 0.0, 0.0, 0.0, 0.0)
    if model not in ("plumb_bob", "rational_polynomial") or any(distortion[5:]) or len(distortion) < 4:
        raise ValueError(
            f"distortion_model {model!r} with {len(distortion)} coefficients is not supported; "
            "must be plumb_bob (k1, k2, p1, p2, k3), or rectify the image first"
        )
    k1, k2, p1, p2, k3 = [*distortion[:5], 0.0][:5]
    return (k1, k2, p1, p2, k3)


def _from_text(content: bytes) -> Intrinsics:
    """The 3x3 block under "# Depth camera intrinsic matrix"."""
    lines = content.decode("utf-8").splitlines()
    title = "# Depth camera intrinsic matrix"
    if title not in lines:
        raise ValueError(f"there is no line {title!r}")
    start = lines.index(title) + 1
    values = [float(word) for line in lines[start : start + 3] for word in line.split()]
    if len(values) != 9:
        raise ValueError(f"line {start + 1}: the intrinsic matrix has {len(values)} values; must be 3 lines of 3")
    return Intrinsics(fx=values[0], cx=values[2], fy=values[4], cy=values[5])
