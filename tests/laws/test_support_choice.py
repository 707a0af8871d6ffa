"""What stands on a plane tells which one is the support: no wall beside it, no flap that hangs level."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.perception import perceive
from boxwright.segmentation import support_plane_of
from boxwright.simulation.frames import make_frame
from boxwright.simulation.physics import cloud_of

FLAPS = [("large", 8301, 122, None), ("part_shut", 8304, 40, 1), ("part_shut", 8304, 114, None)]
"""Level within some degrees, at a table's height over the floor: each was taken for one (the last, seen from below)."""
WALLS = [
    ("cake", 6001, 58, None),
    ("small", 6001, 18, None),
    ("cake", 8001, 52, None),
    ("upright", 8303, 16, 1),
    ("lying", 8305, 28, 1),
]
"""Larger in the image than the table that the box stands on: each of these was taken for the floor."""
BARE = [("large", 8101, 68, None)]
"""The image's edges cut the box all around, so that nothing stands on the floor by its outline."""
TABLES = [("medium", 8501, 55, None), ("cake", 6001, 100, None)]
"""Seen from so far above that nothing is seen to stand on the table: the floor beside it was taken."""
TOPS = [("lying", 8505, 42, 1)]
"""A large box's upper face is as level as a table, and as high."""


@pytest.mark.parametrize(("category", "seed", "index", "boxes"), [*FLAPS, *WALLS, *BARE, *TABLES, *TOPS])
def test_the_support_is_what_the_box_stands_on(category: str, seed: int, index: int, boxes: int | None) -> None:
    frame = make_frame(category, seed, index, boxes=boxes)
    seen = perceive(cloud_of(frame))
    cos = np.clip(np.array(seen.up) @ np.array(frame.truth.up), -1.0, 1.0)
    assert np.degrees(np.arccos(cos)) < 1.0
    support = support_plane_of(seen)
    assert support is not None
    bases = [np.array(part.corners) for part in frame.truth.parts if part.name == "base"]
    lowest_m = min(float((corners @ np.array(support.normal)).min()) - support.distance for corners in bases)
    assert abs(lowest_m) < 0.02
