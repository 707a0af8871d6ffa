"""What `segment` says of a cloud (`segments.json`, docs/formats.md): its planar segments, without meaning.

Metres, seconds; every coordinate is in the input's frame. Values are checked when made; each check raises ValueError.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.checks import require_finite, require_not_negative, require_unit
from boxwright.types.model import Seconds, Source, SupportPlane
from boxwright.types.truth import Vector

EdgeKind = Literal["edge", "crease", "occluded", "border"]

BACKGROUND = -1
"""The group of the support plane and of the room."""


class Segment(msgspec.Struct, frozen=True, kw_only=True):
    """A plane's piece: points p on it have normal . p = distance; `rms` is how far its `points` readings lie from it.

    `rectangle` is the minimum bounding rectangle; side k runs from corner k to the next, and `edges[k]` says what ends
    the segment there: its own end ("edge"), another segment that goes on ("crease"), something nearer that hides what
    follows ("occluded") or the frame ("border"). `hull` goes round. `group` numbers the objects, -1 the background.
    """

    normal: Vector
    distance: float
    rms: float
    points: int
    rectangle: tuple[Vector, Vector, Vector, Vector]
    edges: tuple[EdgeKind, EdgeKind, EdgeKind, EdgeKind]
    hull: tuple[Vector, ...]
    group: int

    def __post_init__(self) -> None:
        require_unit("normal", self.normal)
        require_finite("distance", [self.distance])
        require_not_negative("rms", [self.rms])
        require_not_negative("points", [self.points])
        require_finite("rectangle", [c for corner in self.rectangle for c in corner])
        require_finite("hull", [c for corner in self.hull for c in corner])
        if len(self.hull) < 3:
            raise ValueError(f"hull has {len(self.hull)} corners; must be 3 or more")
        if self.group < BACKGROUND:
            raise ValueError(f"group is {self.group}; must be {BACKGROUND} (background) or more")


class Segmentation(msgspec.Struct, frozen=True, kw_only=True):
    """All that `segment` says of one input; a segment's index is its label. `up` is a unit vector off the support."""

    format: Literal["boxwright.segments"]
    version: Literal[1]
    source: Source
    warnings: tuple[str, ...]
    seconds: Seconds
    up: Vector
    support_plane: SupportPlane | None
    segments: tuple[Segment, ...]

    def __post_init__(self) -> None:
        require_unit("up", self.up)
