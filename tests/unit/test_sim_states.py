"""Boxes that are set up, and boxes on their way to being closed."""

from __future__ import annotations

import pytest

from boxwright.simulation.frames import make_frame

FRAMES = 12


@pytest.mark.parametrize("category", ["upright", "part_shut"])
def test_flaps_are_where_a_packer_leaves_them(category: str) -> None:
    flaps = shut = 0
    for index in range(FRAMES):
        truth = make_frame(category, 11, index, boxes=1, clutter=False).truth
        assert [box.category for box in truth.boxes] == [category]
        angles_deg = [part.angle_deg for part in truth.parts if part.name.startswith("flap")]
        assert all(angle is not None for angle in angles_deg)
        of_box = [angle for angle in angles_deg if angle is not None]
        assert of_box
        if category == "upright":
            # Flaps that met at a corner were turned apart.
            assert sum(80.0 < angle < 100.0 for angle in of_box) >= len(of_box) - 1, (index, of_box)
        else:
            assert any(angle > 25.0 for angle in of_box), (index, of_box)
        flaps += len(of_box)
        shut += sum(angle < 10.0 for angle in of_box)
    assert flaps > 2 * FRAMES
    assert shut == 0 if category == "upright" else shut > FRAMES // 2
