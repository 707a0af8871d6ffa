"""A box as a frozen description. Metres and radians; angles by the joint convention of docs/formats.md."""

from __future__ import annotations

import msgspec

Rgb = tuple[int, int, int]


class Tuck(msgspec.Struct, frozen=True):
    """The flap on a flap's free edge.

    Its angle is against the flap's plane at the flap's own hinge: 0 continues it, positive folds towards the inside of
    the closed box.
    """

    length_m: float
    angle_rad: float
    taper_m: float = 0.0


class Flap(msgspec.Struct, frozen=True):
    """Hinged on the top edge of its side: 0 closed over the opening, pi/2 up, pi flat outward."""

    length_m: float
    angle_rad: float
    inset_m: float
    """From each corner of the box to the end of the hinge."""
    bend_rad: float = 0.0
    """By how much the board turns from hinge to free edge, on a circle; positive opens further."""
    taper_start_m: float = 0.0
    taper_end_m: float = 0.0
    """By how much the free edge is shorter at the start and at the end of the hinge."""
    tuck: Tuck | None = None


class OpenBox(msgspec.Struct, frozen=True):
    """Length and width between mid-surfaces, height from underside to rim; flap k on side k, None if there is none."""

    category: str
    variant: str
    length_m: float
    width_m: float
    height_m: float
    board_m: float
    flaps: tuple[Flap | None, Flap | None, Flap | None, Flap | None]
    rack_rad: float = 0.0
    """How far the corners are from square: positive leans the width's direction towards +x."""
    bulges_m: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)
    """How far the middle of each side stands out."""
    color: Rgb = (196, 150, 98)
    is_closed: bool = False
    """With a top between its sides, flush with their rims, instead of flaps: height is to its upper face."""
