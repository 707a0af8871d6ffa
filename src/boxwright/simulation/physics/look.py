"""Look again: the simulated sensor's frame of boxes as physics left them, with its truth.

The camera stands where it stood: the frame's input is the one that the plan's `base_from_input` is told for. What else
stood in the scene, and the arm, are not in the frame.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.boxes import OpenBox
from boxwright.simulation.frames import Frame, kinect_camera, render
from boxwright.simulation.meshes import rectangle, shell
from boxwright.simulation.panels import Panel
from boxwright.simulation.physics.boards import Board, BoardBox
from boxwright.simulation.physics.slabs import panel_axes
from boxwright.simulation.poses import apply, inverse, translation
from boxwright.simulation.scene import Body, PlacedBox, Scene

Array = NDArray[np.float64]

CATEGORY = "after"
FLOOR_M = (4.0, 4.0)
FLOOR_COLOR = (120, 122, 126)


def look_again(
    boxes: Sequence[BoardBox], base_from_input: Array, seed: int, *, name: str = CATEGORY, noise: float = 1.0
) -> Frame:
    """What the sensor sees of these boxes, told in the robot's base frame, on the floor that the first one stands on.

    `seed` names the sensor's noise: same arguments, same bits. Raises ValueError when there is no box.
    """
    if not boxes:
        raise ValueError("there is no box to look at")
    level_from_base = _levelled(boxes[0])
    placed = tuple(_placed(box, level_from_base) for box in boxes)
    floor = Body(rectangle(FLOOR_M), FLOOR_COLOR)
    camera_from_level = inverse(base_from_input) @ inverse(level_from_base)
    return render(Scene(CATEGORY, placed, (floor,), camera_from_level), kinect_camera(), seed, name, noise)


def _levelled(box: BoardBox) -> Array:
    """level_from_base: z up, the floor at 0 under the lowest corner of the box's base, the origin under the box."""
    up = box.up
    along = np.cross(np.array([0.0, 1.0, 0.0]) if abs(up[1]) < 0.9 else np.array([1.0, 0.0, 0.0]), up)
    along /= np.linalg.norm(along)
    turn = np.eye(4)
    turn[:3, :3] = np.stack([along, np.cross(up, along), up])
    under = apply(turn, box.board("base").corners - box.thickness_m / 2.0 * box.world_from_box[:3, 2])
    centre = under.mean(axis=0)
    return translation([-centre[0], -centre[1], -under[:, 2].min()]) @ turn


def _placed(box: BoardBox, level_from_base: Array) -> PlacedBox:
    box_from_base = inverse(box.world_from_box)
    base, side = box.board("base").corners, next(board for board in box.fixed if board.name.startswith("side")).corners
    length_m, width_m = (float(np.linalg.norm(base[k + 1] - base[k])) for k in (0, 1))
    height_m = float(np.linalg.norm(side[0] - side[3])) + box.thickness_m / 2.0
    described = OpenBox(CATEGORY, CATEGORY, length_m, width_m, height_m, box.thickness_m, (None, None, None, None))
    panels = tuple(_panel(board, box, box_from_base) for board in box.boards)
    return PlacedBox(described, level_from_base @ box.world_from_box, panels)


def _panel(board: Board, box: BoardBox, box_from_base: Array) -> Panel:
    corners = apply(box_from_base, board.corners)
    half = box.thickness_m / 2.0 * panel_axes(corners)[:, 2]
    grid = corners[[0, 1, 3, 2]].reshape(2, 2, 3)
    hinge = board.hinge
    return Panel(
        board.name.replace("_", ""),
        None if hinge is None else hinge.parent.replace("_", ""),
        None if hinge is None else hinge.position_rad,
        corners,
        shell(grid + half, grid - half),
        extra=board.name.startswith("tuck"),
    )
