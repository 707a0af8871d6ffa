"""Scenes without an open box: what a finder of boxes should leave alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.meshes import cuboid
from boxwright.simulation.poses import apply, rotation, standing, translation
from boxwright.simulation.scene import Body

Array = NDArray[np.float64]
Rng = np.random.Generator

CARDBOARD = (196, 150, 98)
WOOD = (150, 112, 78)


def closed_carton(rng: Rng) -> list[Body]:
    """Cartons with their tops shut, side by side or stacked."""
    first = rng.uniform((0.2, 0.16, 0.1), (0.55, 0.4, 0.4))
    bodies = [Body(cuboid(first), CARDBOARD)]
    if rng.random() < 0.5:
        second = rng.uniform(0.5, 0.95) * first
        bodies.append(Body(apply(standing(0, 0, rng.normal(0, 0.3), first[2] + 0.0005), cuboid(second)), CARDBOARD))
    return bodies


def shelf(rng: Rng) -> list[Body]:
    """Two uprights, a back, and boards between them."""
    width, depth, height, board = rng.uniform(0.4, 0.8), rng.uniform(0.2, 0.35), rng.uniform(0.4, 0.9), 0.018
    upright = cuboid((board, depth, height))
    parts = [apply(translation([s * (width - board) / 2, 0, 0]), upright) for s in (-1, 1)]
    level = cuboid((width - 2 * board, depth, board))
    parts += [apply(translation([0, 0, z]), level) for z in np.linspace(0, height - board, int(rng.integers(2, 5)))]
    return [Body(np.concatenate(parts), WOOD)]


def angle_of_boards(rng: Rng) -> list[Body]:
    """Two or three boards that stand against each other at right angles, with or without one on the ground."""
    length, width, height, board = rng.uniform(0.25, 0.5), rng.uniform(0.2, 0.4), rng.uniform(0.15, 0.35), 0.006
    parts = [apply(translation([0, -(width + board) / 2, 0]), cuboid((length, board, height)))]
    parts.append(apply(translation([(length - board) / 2, 0, 0]), cuboid((board, width, height))))
    if rng.random() < 0.5:
        parts.append(apply(translation([-board / 2, 0, 0]), cuboid((length - board, width, board))))
    return [Body(np.concatenate(parts), CARDBOARD)]


def stool(rng: Rng) -> list[Body]:
    """A seat on four legs."""
    side, height = rng.uniform(0.28, 0.4), rng.uniform(0.25, 0.5)
    leg = cuboid((0.035, 0.035, height))
    corner = side / 2 - 0.03
    parts = [apply(translation([x * corner, y * corner, 0]), leg) for x in (-1, 1) for y in (-1, 1)]
    parts.append(apply(translation([0, 0, height]), cuboid((side, side, 0.025))))
    return [Body(np.concatenate(parts), WOOD)]


def leaning_board(rng: Rng) -> list[Body]:
    """A board that leans on a block."""
    tilt = float(np.radians(rng.uniform(10, 35)))
    board = apply(translation([0, 0, 0.003]) @ rotation([1, 0, 0], -tilt), cuboid((rng.uniform(0.2, 0.5), 0.005, 0.4)))
    touch_m = 0.12 * np.tan(tilt) + 0.005 / np.cos(tilt)
    block = apply(translation([0, touch_m + 0.04, 0]), cuboid((0.2, 0.08, 0.12)))
    return [Body(board, CARDBOARD), Body(block, WOOD)]


KINDS = (closed_carton, shelf, angle_of_boards, stool, leaning_board)


def draw_decoys(rng: Rng) -> list[Body]:
    """One kind, turned at random about the vertical, at the origin."""
    bodies = KINDS[int(rng.integers(len(KINDS)))](rng)
    pose = standing(0, 0, rng.uniform(0, 2 * np.pi))
    return [Body(apply(pose, body.triangles), body.color) for body in bodies]
