"""Which true box an inferred one is, and which of its sides is which: a plan names flaps as its model numbers them."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import Board, BoardBox, Hinge

Array = NDArray[np.float64]

FARTHEST_M = 0.3
"""A true box whose rim is farther than this from the inferred one's, on average, is another box."""


def matched(boxes: Sequence[BoardBox], modelled: BoardBox) -> tuple[int, BoardBox]:
    """The nearest of the true boxes, and that box with its sides numbered as the inferred one's.

    Near is the mean distance between the middles of the rims' edges, over the four ways to number them.

    Raises ValueError when none is nearer than FARTHEST_M.
    """
    k, shift = match_of(boxes, modelled)
    return k, renumbered(boxes[k], shift)


def match_of(boxes: Sequence[BoardBox], modelled: BoardBox) -> tuple[int, int]:
    """As `matched`: the nearest box, and s where its side (k + s) mod 4 is the inferred one's side k."""
    found = [(_mean_distance_m(box, modelled, shift), k, shift) for k, box in enumerate(boxes) for shift in range(4)]
    if not found or min(found)[0] > FARTHEST_M:
        raise ValueError(f"no true box is within {FARTHEST_M} m of the planned one; is it the truth of the same frame?")
    _, k, shift = min(found)
    return k, shift


def renumbered(box: BoardBox, shift: int) -> BoardBox:
    """The same box with side k called side (k - shift) mod 4, and flaps and what hangs on them alike."""

    def new_name(name: str) -> str:
        stem, separator, number = name.partition("_")
        return f"{stem}_{(int(number) - shift) % 4}" if separator else name

    def new_board(board: Board) -> Board:
        hinge = board.hinge
        if hinge is not None:
            hinge = Hinge(new_name(hinge.parent), hinge.origin, hinge.axis, hinge.position_rad, hinge.length_m)
        return Board(new_name(board.name), board.corners, hinge)

    return msgspec.structs.replace(box, boards=tuple(new_board(board) for board in box.boards))


def _rim(box: BoardBox) -> dict[int, Array]:
    """The middle (3) of each side's top edge, by the side's number."""
    sides = [board for board in box.fixed if board.name.startswith("side")]
    return {int(board.name[-1]): (board.corners[0] + board.corners[1]) / 2.0 for board in sides}


def _mean_distance_m(box: BoardBox, modelled: BoardBox, shift: int) -> float:
    here, there = _rim(box), _rim(modelled)
    pairs = [(here[(k + shift) % 4], place) for k, place in there.items() if (k + shift) % 4 in here]
    return float(np.mean([np.linalg.norm(a - b) for a, b in pairs])) if pairs else float("inf")
