"""The states of parts in answers of the exact search: seen, hidden, absent."""

from __future__ import annotations

import numpy as np

import boxwright
from boxwright.simulation import make_frame
from boxwright.types import Cloud

EXACT = {"search": "exact"}
ORIGIN = (0.0, 0.0, 0.0)


def test_seen_parts_are_told_seen_and_what_is_looked_through_is_not() -> None:
    told, seen = 0, 0
    for seed in (2, 3, 4):
        frame = make_frame("carton", seed=seed, boxes=1)
        cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=ORIGIN)
        model = boxwright.infer(cloud, method="paper", planes="grid", search=EXACT).model
        assert model.free_space == "used"
        for part in [part for box in model.objects for part in box.parts]:
            assert (part.state is None) == (part.corners is None)
            if part.observed and part.state is not None and part.points > 2000:
                told, seen = told + 1, seen + (part.state.seen > 0.5)
    assert told >= 10
    assert seen >= 0.9 * told


def test_without_rays_nothing_is_told() -> None:
    frame = make_frame("carton", seed=2, boxes=1)
    points = frame.points[np.isfinite(frame.points).all(axis=1)]
    cloud = Cloud(points=points, width=len(points), height=1)
    model = boxwright.infer(cloud, method="paper", up=frame.truth.up, search=EXACT).model
    assert model.free_space == "no viewpoint"
    assert all(part.state is None for box in model.objects for part in box.parts)
    staged = boxwright.infer(
        Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=ORIGIN), method="paper"
    )
    assert staged.model.free_space == "not used"
