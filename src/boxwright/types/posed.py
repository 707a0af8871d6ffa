"""Frames of one scene with the places that they were taken from."""

from __future__ import annotations

from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.types.checks import require_finite, require_rigid
from boxwright.types.cloud import Cloud

FARTHEST_M = 20.0
"""No camera on an arm is farther from its base: what is, was told in millimetres."""


class PosedFile(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """A cloud's file, and base_from_camera (4, 4): from the file's coordinates to those of one fixed frame, metres.

    Raises ValueError where that is no rigid motion, or farther away than any arm reaches.
    """

    file: Path
    base_from_camera: NDArray[np.float64]

    def __post_init__(self) -> None:
        _require_pose(self.base_from_camera)


class PosedCloud(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """A cloud, and base_from_camera (4, 4): from its coordinates to those of one fixed frame, metres.

    Raises ValueError where that is no rigid motion, or farther away than any arm reaches.
    """

    cloud: Cloud
    base_from_camera: NDArray[np.float64]

    def __post_init__(self) -> None:
        _require_pose(self.base_from_camera)


def _require_pose(base_from_camera: NDArray[np.float64]) -> None:
    require_rigid("base_from_camera", base_from_camera)
    far_m = float(np.linalg.norm(base_from_camera[:3, 3]))
    require_finite("base_from_camera", [far_m])
    if far_m > FARTHEST_M:
        raise ValueError(f"base_from_camera puts the camera {far_m:.4g} m away; poses are in metres, not millimetres")
