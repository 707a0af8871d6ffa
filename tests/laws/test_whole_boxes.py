"""Boxes of which little but a lid shows are found and measured, and a second look loses none."""

from __future__ import annotations

import numpy as np
import pytest

import boxwright
from boxwright.simulation.frames import make_frame
from boxwright.simulation.physics import cloud_of

SEEDS = (7, 16, 20)
"""Of pizza boxes that no walls propose: without lids each of these frames has no object."""


@pytest.mark.parametrize("seed", SEEDS)
def test_a_lid_proposes_its_box(seed: int) -> None:
    frame = make_frame("pizza", seed, boxes=1)
    (found,) = boxwright.infer(cloud_of(frame)).model.objects
    true = frame.truth.boxes[0].dims
    assert true is not None
    assert found.dimensions is not None
    sizes = [np.sort(lengths[:2]) for lengths in (true, found.dimensions)]
    assert np.abs(sizes[0] - sizes[1]).max() < 0.03
    assert abs(true[2] - found.dimensions[2]) < 0.015
    assert sum(part.observed for part in found.parts) >= 3


def test_a_second_look_at_the_flaps_takes_nothing_away() -> None:
    """Its scan of an edge of this box, fitted, holds less than what was there: the box was lost with it."""
    frame = make_frame("cake", 6, boxes=1)
    (found,) = boxwright.infer(cloud_of(frame)).model.objects
    observed = {part.name for part in found.parts if part.observed}
    assert observed >= {"flap_0", "flap_1", "flap_2", "flap_3", "tuck_0"}
