"""Outer sizes that a user knows boxes to have."""

from __future__ import annotations

import msgspec

from boxwright.types.checks import require_positive
from boxwright.types.truth import Vector


class KnownSize(msgspec.Struct, frozen=True, kw_only=True):
    """An outer size by its name: three lengths in any order, metres."""

    name: str
    outer: Vector

    def __post_init__(self) -> None:
        if not self.name.strip():
            raise ValueError("name is empty; a size has one")
        require_positive("outer", self.outer)


class MatchedSize(msgspec.Struct, frozen=True, kw_only=True):
    """The given size that an object has: its outer lengths along the object's length, width and height, metres."""

    name: str
    outer_dimensions: Vector

    def __post_init__(self) -> None:
        require_positive("outer_dimensions", self.outer_dimensions)
