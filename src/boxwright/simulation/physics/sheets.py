"""What flaps meet other flaps with: thin sheets within their boards.

All hinges of a told box are at the rim, at mid-board (docs/formats.md). Stiff boards on such hinges could not lie over
one another: in a real carton the outer flaps' score lines are a board higher, creases are crushed, board bends. So a
flap has two sheets. The outer one, above mid-board, meets the inner ones, below mid-board, of the neighbours that it
lies over: two closed flaps lie flush. The inner one ends before the flap's ends: where an outer flap comes down beside
its own hinge on the end of an inner flap that has sprung up, that end gives way. Neighbours that both stand up meet
with their inner sheets. layers.py says who lies over whom.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import Board, BoardBox
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.slabs import Slab, Trim, panel_axes, slabs_of

Array = NDArray[np.float64]

TUCK_BIT = 1 << 14


class Touches(msgspec.Struct, frozen=True):
    """MuJoCo's two masks: two geoms touch where one's kind is among what the other meets."""

    kind: int
    meets: int

    def as_geom(self) -> dict[str, int]:
        """As a geom's attributes."""
        return {"contype": self.kind, "conaffinity": self.meets}


class Sheet(msgspec.Struct, frozen=True, eq=False):
    """A sheet: what it is called on its board, where it is, and what it meets."""

    name: str
    slab: Slab
    touches: Touches


def over_bit(flap: int, neighbour: int) -> int:
    """The kind of contact of flap `flap` (0-3) lying over its neighbour, each a bit of its own."""
    return 1 << (4 + 2 * flap + (1 if (neighbour - flap) % 4 == 1 else 0))


def beside_bit(flap: int, neighbour: int) -> int:
    """The kind of contact of two neighbours that both stand up, the same for either."""
    return 1 << (15 + (flap if (neighbour - flap) % 4 == 1 else neighbour))


def sheets_of(box: BoardBox, board: Board, settings: PhysicsSettings) -> Iterator[Sheet]:
    """The sheets of a board, none where it is fixed. A flap on a flap has one in the middle, its ends left out."""
    if board.hinge is None:
        return
    thickness_m, ends = min(settings.sheet_m, box.thickness_m), _ends(board.corners, settings)
    if not board.name.startswith("flap"):
        for k, slab in enumerate(slabs_of(board.corners, thickness_m, ends)):
            yield Sheet(f"sheet_{k}", slab, Touches(TUCK_BIT, TUCK_BIT))
        return
    number = int(board.name[-1])
    above = 0.5 * thickness_m * np.cross(board.hinge.axis, panel_axes(board.corners)[:, 1])
    for k, slab in enumerate(slabs_of(board.corners, thickness_m)):
        yield Sheet(f"outer_{k}", _moved(slab, above), outer_touches(number))
    for k, slab in enumerate(slabs_of(board.corners, thickness_m, ends)):
        yield Sheet(f"inner_{k}", _moved(slab, -above), inner_touches(number))


def outer_touches(flap: int) -> Touches:
    """A flap's outer sheet: it may lie over both neighbours, and meets the opposite flap's outer sheet."""
    opposite = 1 << (12 + flap % 2)
    return Touches(over_bit(flap, (flap + 1) % 4) | over_bit(flap, (flap + 3) % 4) | opposite, opposite)


def inner_touches(flap: int) -> Touches:
    """A flap's inner sheet: its neighbours may lie over it or stand beside it, and flaps on flaps meet it."""
    next_one, last_one = (flap + 1) % 4, (flap + 3) % 4
    beside = beside_bit(flap, next_one) | beside_bit(flap, last_one)
    return Touches(beside, over_bit(next_one, flap) | over_bit(last_one, flap) | beside | TUCK_BIT)


def _moved(slab: Slab, offset: Array) -> Slab:
    return msgspec.structs.replace(slab, centre=slab.centre + offset)


def _ends(corners: Array, settings: PhysicsSettings) -> Trim:
    """At least half of a narrow panel stays."""
    narrowest_m = float(min(np.linalg.norm(corners[1] - corners[0]), np.linalg.norm(corners[2] - corners[3])))
    return Trim(ends_m=min(settings.sheet_ends_m, narrowest_m / 4.0))
