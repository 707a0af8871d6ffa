"""The pinhole camera of a depth image."""

from __future__ import annotations

import msgspec


class Intrinsics(msgspec.Struct, frozen=True, kw_only=True):
    """Pinhole intrinsics in pixels; integer pixel coordinates are pixel centres.

    `width` and `height` are None where the source does not say them (then any image is taken), `depth_unit_m`, metres
    of one step of the image, likewise (then the caller must say it). `distortion` is k1, k2, p1, p2, k3 (Brown-Conrady,
    the order of OpenCV and of ROS's plumb_bob).
    """

    fx: float
    fy: float
    cx: float
    cy: float
    width: int | None = None
    height: int | None = None
    depth_unit_m: float | None = None
    distortion: tuple[float, float, float, float, float] = (0.0, 0.0, 0.0, 0.0, 0.0)

    def __post_init__(self) -> None:
        if (self.width is None) != (self.height is None):
            raise ValueError("width and height must be there both, or neither")

    @property
    def size(self) -> tuple[int, int] | None:
        """Columns and rows of the image, where they are known."""
        return None if self.width is None or self.height is None else (self.width, self.height)
