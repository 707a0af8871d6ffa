"""What is really there in a labelled frame (`NAME.truth.json`)."""

from __future__ import annotations

import msgspec

Vector = tuple[float, float, float]
"""A point in metres or a unit vector, in the input's frame."""


class Camera(msgspec.Struct, frozen=True):
    """Pinhole intrinsics in pixels."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int


class TrueBox(msgspec.Struct, frozen=True):
    """One open box of the frame; `dims` is length, width, height in metres, None where nobody measured them."""

    index: int
    category: str
    variant: str
    dims: tuple[float, float, float] | None


class TruePart(msgspec.Struct, frozen=True):
    """One panel. Corners in metres, input's frame, order of docs/formats.md.

    `angle_deg` is None where nothing turns, and of a flap where nobody measured it: its corners are then those of the
    rectangle around its readings, going round from any, and tell no hinge.
    """

    box: int
    name: str
    parent: str | None
    extra: bool
    angle_deg: float | None
    corners: tuple[Vector, Vector, Vector, Vector]
    visible_px: int


class TrueFace(msgspec.Struct, frozen=True):
    """A flat face that is no panel: of a floor, a wall, a table, a thing. Plane normal . p = distance, input's frame.

    The normal is turned towards the camera.
    """

    normal: Vector
    distance: float
    visible_px: int


class Truth(msgspec.Struct, frozen=True):
    """A frame's truth. Label `k` of `NAME.labels.npz` is `parts[k - 1]`; 0 is none.

    So are the first of its `faces`; those beyond the parts go on with this record's `faces`: `P + k` is `faces[k - 1]`
    where there are P parts. Sets that do not tell faces have none here and no such array. `camera` is None where a
    person gave the labels.
    """

    name: str
    category: str
    camera: Camera | None
    up: Vector
    boxes: tuple[TrueBox, ...]
    parts: tuple[TruePart, ...]
    faces: tuple[TrueFace, ...] = ()
