"""What a person may have mixed up: the way round, and pieces that cannot be one panel."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from boxwright.evaluation.roles import FLAP, ROTATIONS
from boxwright.types import Segment
from boxwright.types.truth import Vector

PIECES_ANGLE_RAD = math.radians(20.0)
PIECES_OFFSET_M = 0.03
"""Pieces of one panel that are farther apart than these are told: a bent flap's pieces are not."""

SIDE = "side"


def odd_pieces(pieces: Sequence[Segment]) -> Iterator[tuple[int, str]]:
    """The pieces that do not go on the plane of the one with most readings, and by how much."""
    largest = max(pieces, key=lambda piece: piece.points)
    normal = np.array(largest.normal)
    for k, piece in enumerate(pieces):
        turn_rad = math.acos(min(abs(float(normal @ np.array(piece.normal))), 1.0))
        off_m = abs(float(np.mean(piece.rectangle, axis=0) @ normal) - largest.distance)
        if turn_rad > PIECES_ANGLE_RAD or off_m > PIECES_OFFSET_M:
            yield k, f"turned {math.degrees(turn_rad):.0f} deg and {1000 * off_m:.0f} mm off"


def goes_clockwise(pieces_of: Mapping[str, Sequence[Segment]], up: Vector) -> bool:
    """Whether a box's sides, or flaps where a side has no segment, are numbered clockwise seen from above.

    They are to be counter-clockwise (docs/formats.md). Fewer than three do not tell.
    """
    around = [
        np.mean([corner for piece in pieces for corner in piece.rectangle], axis=0)
        for k in ROTATIONS
        if (pieces := pieces_of.get(f"{SIDE}_{k}") or pieces_of.get(f"{FLAP}_{k}"))
    ]
    if len(around) < 3:
        return False
    # Twice the enclosed area, seen from above.
    turns = [np.cross(b - around[0], c - around[0]) for b, c in pairwise(around[1:])]
    return float(np.sum(turns, axis=0) @ np.array(up)) < 0.0
