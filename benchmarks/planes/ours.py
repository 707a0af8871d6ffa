"""boxwright's own ways from an array to a segment's number for each point."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from boxwright.perception import perceive
from boxwright.types import Cloud

PLANES = ("grid", "ransac")
ORIGIN = (0.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)


@cache
def has_planes(planes: str) -> bool:
    """Does this build have this way of finding planes? It refuses a setting before it looks at the cloud."""
    nothing = Cloud(points=np.full((1, 3), np.nan, np.float32), width=1, height=1)
    settings: dict[str, Any] = {"planes": planes}
    try:
        perceive(nothing, **settings)
    except (TypeError, ValueError) as refused:
        return "perception setting" not in str(refused)
    return True


def labels_of(points: NDArray[np.float32], width: int, height: int, planes: str) -> NDArray[np.int32]:
    """Segments of a frame seen from the origin, or of an unorganized cloud with z up."""
    organized = height > 1
    cloud = Cloud(points=points, width=width, height=height, viewpoint=ORIGIN if organized else None)
    settings: dict[str, Any] = {"planes": planes}
    return perceive(cloud, up=None if organized else UP, **settings).labels
