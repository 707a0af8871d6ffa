"""What a frame looks at: boxes and other bodies in the world (z up, the support at z = 0), and the camera's pose."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.boxes import OpenBox, Rgb
from boxwright.simulation.panels import Panel, build_panels
from boxwright.simulation.poses import apply

Array = NDArray[np.float64]


class Body(msgspec.Struct, frozen=True, eq=False):
    """Something without labels: triangles (T, 3, 3), metres, world frame."""

    triangles: Array
    color: Rgb


class PlacedBox(msgspec.Struct, frozen=True, eq=False):
    """An open box in the world, its panels in the box's frame."""

    box: OpenBox
    world_from_box: Array
    panels: tuple[Panel, ...]

    def triangles_world(self) -> Array:
        """All boards, (T, 3, 3)."""
        return apply(self.world_from_box, np.concatenate([panel.triangles for panel in self.panels]))


def place(box: OpenBox, world_from_box: Array) -> PlacedBox:
    return PlacedBox(box, world_from_box, tuple(build_panels(box)))


class Scene(msgspec.Struct, frozen=True, eq=False):
    """Everything that a frame can show."""

    category: str
    boxes: tuple[PlacedBox, ...]
    bodies: tuple[Body, ...]
    camera_from_world: Array
