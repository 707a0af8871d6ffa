"""Where a box has got to: its boards as they stand now, and how far it came."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import Board, BoardBox, Hinge
from boxwright.simulation.physics.box_bodies import board_frame
from boxwright.simulation.physics.state import flap_positions_rad, world_from_body
from boxwright.simulation.physics.world import World
from boxwright.simulation.poses import apply, inverse

Array = NDArray[np.float64]


def box_as_it_stands(world: World, data: mujoco.MjData, box: BoardBox) -> BoardBox:
    """The same boards where they are in this state, hinges and their positions with them."""
    positions = flap_positions_rad(world, data)
    motions = {
        board.name: world_from_body(world, data, world.box.body_of[board.name]) @ inverse(board_frame(board))
        for board in box.boards
    }
    boards = []
    for board in box.boards:
        hinge = board.hinge
        if hinge is not None:
            carried = motions[hinge.parent]
            hinge = Hinge(
                hinge.parent,
                apply(carried, hinge.origin),
                carried[:3, :3] @ hinge.axis,
                positions[board.name],
                hinge.length_m,
            )
        boards.append(Board(board.name, apply(motions[board.name], board.corners), hinge))
    world_from_box = world_from_body(world, data, world.box.root)
    return msgspec.structs.replace(box, boards=tuple(boards), world_from_box=world_from_box)


def way_and_turn(first: Array, last: Array, up: Array) -> tuple[float, float]:
    """Way along the floor (m) and turn (rad) between two poses (4, 4)."""
    way = last[:3, 3] - first[:3, 3]
    turn = first[:3, :3].T @ last[:3, :3]
    slid_m = float(np.linalg.norm(way - (way @ up) * up))
    return slid_m, float(np.arccos(np.clip((np.trace(turn) - 1.0) / 2.0, -1.0, 1.0)))
