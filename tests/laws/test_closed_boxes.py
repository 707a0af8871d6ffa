"""Closed cartons, where their template is named: found by their outside, measured, and no open box's readings taken."""

from __future__ import annotations

import numpy as np
import pytest

import boxwright
from boxwright.simulation.frames import make_frame
from boxwright.simulation.physics import cloud_of
from boxwright.types import Cloud
from boxwright.types.model import Object

OPEN = ("carton", "cake_box", "pizza_box", "tote")
BOTH = (*OPEN, "closed_carton")


def closed_of(objects: tuple[Object, ...]) -> list[Object]:
    return [found for found in objects if found.template == "closed_carton"]


@pytest.mark.parametrize("index", [1, 3, 10, 13, 16, 19])
def test_a_closed_carton_is_measured_and_nothing_of_it_turns(index: int) -> None:
    frame = make_frame("closed", 9004, index)
    found = closed_of(boxwright.infer(cloud_of(frame), templates=("closed_carton",)).model.objects)
    (box,) = frame.truth.boxes
    assert box.dims is not None
    near = [one for one in found if one.dimensions and np.abs(np.sort(one.dimensions) - np.sort(box.dims)).max() < 0.01]
    (one,) = near
    assert one.dimensions is not None
    # Side 0 is a longer one (docs/formats.md).
    assert one.dimensions[0] > one.dimensions[1] - 0.01
    assert one.joints == ()
    assert one.probability is None
    seen = {part.name for part in one.parts if part.observed}
    assert "top" in seen
    assert len(seen) == 3
    assert all(part.corners is not None for part in one.parts)


def test_it_competes_only_where_it_is_named_and_takes_no_open_box() -> None:
    open_frames = found_closed = 0
    for index in range(6):
        cloud = cloud_of(make_frame(("small", "large", "carton")[index % 3], 31, index, boxes=1))
        alone, both = (boxwright.infer(cloud, templates=names).model.objects for names in (OPEN, BOTH))
        assert closed_of(alone) == []
        assert [one.pose for one in both if one.template in OPEN] == [one.pose for one in alone]
        open_frames += len(alone) > 0
        found_closed += len(closed_of(both))
    assert open_frames >= 4
    # Books and blocks beside the boxes are closed boxes too.
    assert found_closed <= 4


def test_who_cannot_tell_closed_boxes_says_so() -> None:
    cloud = cloud_of(make_frame("closed", 9004, 1))
    for method in ("exact", "paper"):
        with pytest.raises(ValueError, match=r"closed_carton.*fitted"):
            boxwright.infer(cloud, method=method, templates=("closed_carton",))
    points = cloud.points[np.isfinite(cloud.points).all(axis=1)]
    loose = Cloud(points=points, width=len(points), height=1, viewpoint=(0.0, 0.0, 0.0))
    inferred = boxwright.infer(loose, templates=("carton", "closed_carton"))
    assert closed_of(inferred.model.objects) == []
    assert any("closed boxes were not looked for" in line for line in inferred.model.warnings)
    assert boxwright.infer(loose, templates=("closed_carton",)).model.objects == ()
