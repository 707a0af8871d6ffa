"""Draws a whole scene from a random generator."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.arrangement import arrange_boxes, arrange_clutter, arrange_things
from boxwright.simulation.conditions import DRAWN, Conditions
from boxwright.simulation.empty import draw_decoys
from boxwright.simulation.kinds import FURTHER_KINDS, KINDS
from boxwright.simulation.scene import Body, PlacedBox, Scene
from boxwright.simulation.states import LYING
from boxwright.simulation.surroundings import draw_support, draw_walls, is_before
from boxwright.simulation.views import draw_view, position_in_world
from boxwright.types import Camera

CATEGORIES = tuple(KINDS)
"""The six that hold open boxes, drawn in turn."""
FURTHER_CATEGORIES = tuple(FURTHER_KINDS)
"""Those that hold open boxes and are drawn only where they are named."""
NONE = "none"
"""Frames without an open box."""
BOX_COUNTS = (0.72, 0.2, 0.08)
"""How often a frame holds one, two, three boxes where the number is not given."""


def draw_scene(
    rng: np.random.Generator,
    category: str,
    camera: Camera,
    boxes: int | None,
    *,
    clutter: bool,
    conditions: Conditions = DRAWN,
) -> Scene:
    """A scene of a category, with `boxes` open boxes (drawn where None), under `conditions`."""
    count = 0 if category == NONE else boxes if boxes is not None else 1 + int(rng.choice(3, p=BOX_COUNTS))
    placed, bodies = arrange_boxes(rng, category, count, conditions.variant)
    if not placed:
        bodies = draw_decoys(rng)
    content = np.concatenate([box.triangles_world() for box in placed] + [body.triangles for body in bodies]).reshape(
        -1, 3
    )
    extent_m = 2 * float(np.abs(content[:, :2]).max()) + 0.1
    support = draw_support(rng, extent_m)
    opens_towards_rad = _heading(placed[0].world_from_box[:3, 2]) if category == LYING else None
    camera_from_world, heading = draw_view(rng, category, content, camera, conditions, opens_towards_rad)
    walls = draw_walls(rng, support, heading, extent_m / 2 + float(rng.uniform(0.15, 1.2)))
    walls = [wall for wall in walls if is_before(position_in_world(camera_from_world), wall)]
    things = _things(rng, placed, bodies + walls, support.reach_m, conditions) if clutter else []
    return Scene(category, tuple(placed), (*support.bodies, *bodies, *walls, *things), camera_from_world)


def _heading(direction: NDArray[np.float64]) -> float:
    return float(np.arctan2(direction[1], direction[0]))


def _things(
    rng: np.random.Generator,
    boxes: list[PlacedBox],
    present: list[Body],
    reach_m: tuple[float, float],
    conditions: Conditions,
) -> list[Body]:
    if conditions.things is None:
        return arrange_clutter(rng, boxes, present, reach_m)
    return arrange_things(rng, boxes, present, reach_m, conditions.things)
