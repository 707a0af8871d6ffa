"""When a flap counts as closed (docs/formats.md)."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.box_bodies import board_frame
from boxwright.simulation.physics.state import flap_positions_rad, world_from_body
from boxwright.simulation.physics.world import World
from boxwright.simulation.poses import apply, inverse

Array = NDArray[np.float64]

CLOSED_RAD = float(np.radians(15.0))
LYING_RAD = float(np.radians(30.0))


def closed_boards(world: World, data: mujoco.MjData, box: BoardBox) -> set[str]:
    """Flaps that are closed now, and flaps on flaps that are tucked in: their flap is closed, they end in the box."""
    positions = flap_positions_rad(world, data)
    flaps = {name: angle for name, angle in positions.items() if not name.startswith("tuck")}
    closed = {name for name, angle in flaps.items() if abs(angle) <= CLOSED_RAD}
    touching = _touching(world, data)
    lying = {name for name, angle in flaps.items() if CLOSED_RAD < angle <= LYING_RAD}
    while found := {name for name in lying - closed if any(frozenset((name, on)) in touching for on in closed)}:
        closed |= found
    return closed | {name for name in positions if _is_tucked(world, data, box, name, closed)}


def _touching(world: World, data: mujoco.MjData) -> set[frozenset[str]]:
    """Pairs of the box's boards that touch."""
    name_of = {world.model.body(body).id: name for name, body in world.box.body_of.items()}
    bodies = world.model.geom_bodyid[data.contact.geom] if data.ncon else np.zeros((0, 2), dtype=int)
    return {frozenset((name_of[a], name_of[b])) for a, b in bodies.tolist() if a in name_of and b in name_of}


def _is_tucked(world: World, data: mujoco.MjData, box: BoardBox, name: str, closed: set[str]) -> bool:
    board = box.board(name)
    if not name.startswith("tuck") or board.hinge is None or board.hinge.parent not in closed:
        return False
    free_edge = apply(inverse(board_frame(board)), board.corners[2:].mean(axis=0))
    box_from_board = inverse(world_from_body(world, data, world.box.root)) @ world_from_body(
        world, data, world.box.body_of[name]
    )
    x, y, z = apply(box_from_board, free_edge)
    half_x, half_y, rim = _inside(box)
    return bool(z < rim and abs(x) < half_x and abs(y) < half_y)


def _inside(box: BoardBox) -> Array:
    """Half of length and width, and the rim's height, box frame: the corners' farthest."""
    corners = np.concatenate([apply(inverse(box.world_from_box), board.corners) for board in box.fixed])
    reach: Array = np.abs(corners).max(axis=0)
    return reach
