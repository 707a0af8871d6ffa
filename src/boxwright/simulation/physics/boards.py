"""A box as rigid boards on hinges: what physics knows of it, from a frame's truth or from a model.

Every coordinate is in the world's frame, which is the robot's base frame (metres). Names are those of docs/formats.md,
with the underscore.
"""

from __future__ import annotations

import re

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.poses import apply
from boxwright.types import Object, TruePart, Truth
from boxwright.types.board import BOARD_THICKNESS_M

Array = NDArray[np.float64]

THINNEST_M = 0.0005
"""A truth whose sides reach down to the underside tells no thickness; rounding leaves less than this."""

SUPPORTED_TILT_RAD = np.radians(20.0)
"""A base that leans more is no box that stands on something."""


class Hinge(msgspec.Struct, frozen=True, eq=False):
    """A crease. Turning the board about `axis` (3, unit) through `origin` (3) by the right hand grows its position."""

    parent: str
    origin: Array
    axis: Array
    position_rad: float
    length_m: float


class Board(msgspec.Struct, frozen=True, eq=False):
    """A panel: its corners (4, 3) at mid-board, in the order of docs/formats.md; `hinge` is None where it is fixed."""

    name: str
    corners: Array
    hinge: Hinge | None


class BoardBox(msgspec.Struct, frozen=True, eq=False):
    """An open box that stands free: fixed boards (base and sides) first, then those on hinges, parents before children.

    `up` (3, unit) is away from the floor, `world_from_box` (4, 4) has its origin at the centre of the base's underside,
    z out of the opening and x along side_0.
    """

    boards: tuple[Board, ...]
    thickness_m: float
    up: Array
    world_from_box: Array

    def board(self, name: str) -> Board:
        """The board of that name; KeyError where there is none."""
        for board in self.boards:
            if board.name == name:
                return board
        raise KeyError(name)

    @property
    def fixed(self) -> tuple[Board, ...]:
        """Base and sides."""
        return tuple(board for board in self.boards if board.hinge is None)

    @property
    def hinged(self) -> tuple[tuple[Board, Hinge], ...]:
        """Flaps and flaps on flaps, with their creases."""
        return tuple((board, board.hinge) for board in self.boards if board.hinge is not None)


def true_box(truth: Truth, index: int, world_from_input: Array, thickness_m: float | None = None) -> BoardBox:
    """Box `index` of a frame's truth. `thickness_m` goes before what the truth tells of the board.

    The boards are flat: a bent flap is taken along its tangent at the hinge, which its position is told of.

    Raises ValueError when the truth has no such box, or tells too little of it to build it.
    """
    if not 0 <= index < len(truth.boxes):
        raise ValueError(f"{truth.name}: box {index} is not there; the truth has {len(truth.boxes)}, counted from 0")
    parts = [part for part in truth.parts if part.box == index]
    boards = tuple(_true_board(truth.name, part, world_from_input) for part in parts)
    up = world_from_input[:3, :3] @ np.array(truth.up)
    told_m = thickness_m or _told_thickness(truth, index, parts) or BOARD_THICKNESS_M
    return _standing(f"{truth.name}: box {index}", boards, told_m, up)


def modelled_box(
    found: Object, up: tuple[float, float, float], world_from_input: Array, thickness_m: float | None = None
) -> BoardBox:
    """An inferred object, every part of it that has corners; `up` as its model tells it, input's frame.

    Raises ValueError when the object has no base, no side, or hinges that are nowhere.
    """
    hinges = {joint.child: joint for joint in found.joints}
    boards = []
    for part in found.parts:
        if part.corners is None:
            continue
        corners, hinge = apply(world_from_input, np.array(part.corners)), None
        if part.name in hinges:
            joint = hinges[part.name]
            origin = apply(world_from_input, np.array(joint.origin))
            axis = world_from_input[:3, :3] @ np.array(joint.axis)
            hinge = Hinge(joint.parent, origin, axis, joint.position, float(np.linalg.norm(corners[1] - corners[0])))
        boards.append(Board(part.name, corners, hinge))
    told_m = thickness_m or found.thickness or BOARD_THICKNESS_M
    return _standing(f"object {found.template!r}", tuple(boards), told_m, world_from_input[:3, :3] @ np.array(up))


def _true_board(name: str, part: TruePart, world_from_input: Array) -> Board:
    corners = apply(world_from_input, np.array(part.corners))
    if part.parent is None:
        return Board(_underscored(part.name), corners, None)
    if part.angle_deg is None:
        raise ValueError(f"{name}: {part.name} has no angle_deg; physics needs a truth that tells every hinge")
    edge = corners[1] - corners[0]
    length_m = float(np.linalg.norm(edge))
    # A flap on a flap turns the other way round, so that folding inward grows its position (docs/formats.md).
    axis = (-edge if part.extra else edge) / length_m
    origin = (corners[0] + corners[1]) / 2.0
    hinge = Hinge(_underscored(part.parent), origin, axis, float(np.radians(part.angle_deg)), length_m)
    return Board(_underscored(part.name), corners, hinge)


def _underscored(name: str) -> str:
    return re.sub(r"^([a-z]+)(\d+)$", r"\1_\2", name)


def _told_thickness(truth: Truth, index: int, parts: list[TruePart]) -> float | None:
    """Sides reach from the base's middle, half a board above the underside, to the rim."""
    dims = truth.boxes[index].dims
    sides = [np.array(part.corners) for part in parts if part.name.startswith("side")]
    if dims is None or not sides:
        return None
    thickness_m = 2.0 * (dims[2] - float(np.linalg.norm(sides[0][0] - sides[0][3])))
    return thickness_m if thickness_m > THINNEST_M else None


def _standing(what: str, boards: tuple[Board, ...], thickness_m: float, up: Array) -> BoardBox:
    fixed = {board.name: board for board in boards if board.hinge is None}
    if "base" not in fixed or not any(name.startswith("side") for name in fixed):
        raise ValueError(f"{what} has no base or no side; a box that stands has both")
    ordered = sorted(boards, key=lambda board: (board.hinge is not None, board.name.startswith("tuck")))
    known = set()
    for board in ordered:
        if board.hinge is not None and board.hinge.parent not in known:
            raise ValueError(f"{what}: {board.name} hangs on {board.hinge.parent!r}, which is no part of it")
        known.add(board.name)
    world_from_box = _box_frame(fixed, thickness_m, up)
    if world_from_box[:3, 2] @ up < np.cos(SUPPORTED_TILT_RAD):
        tilt_deg = float(np.degrees(np.arccos(np.clip(world_from_box[:3, 2] @ up, -1.0, 1.0))))
        raise ValueError(f"{what} leans by {tilt_deg:.0f} degrees; a box that stands leans by 20 at most")
    return BoardBox(tuple(ordered), thickness_m, up, world_from_box)


def _box_frame(fixed: dict[str, Board], thickness_m: float, up: Array) -> Array:
    base = fixed["base"].corners
    along = (base[1] - base[0]) / np.linalg.norm(base[1] - base[0])
    out = np.cross(along, base[2] - base[1])
    out /= np.linalg.norm(out)
    out = out if out @ up > 0 else -out
    frame = np.eye(4)
    frame[:3, :3] = np.column_stack([along, np.cross(out, along), out])
    frame[:3, 3] = base.mean(axis=0) - thickness_m / 2.0 * out
    return frame
