"""Boxes that are set up, boxes on their way to being closed, and boxes on their side."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.simulation.drawing import draw_scene
from boxwright.simulation.frames import kinect_camera, make_frame
from boxwright.simulation.poses import apply, inverse

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


def test_boxes_on_their_side_lie_on_it_and_open_towards_the_camera() -> None:
    sides = set()
    for index in range(FRAMES):
        scene = draw_scene(np.random.default_rng((11, index)), "lying", kinect_camera(), 1, clutter=True)
        (placed,) = scene.boxes
        up = placed.world_from_box[:3, 2]
        assert abs(up[2]) < 1e-9
        camera = inverse(scene.camera_from_world)[:3, 3] - placed.world_from_box[:3, 3]
        # Seen from above the heading says nothing.
        assert up @ camera > 0 or camera[2] > 0.8 * np.linalg.norm(camera), index
        below = {
            panel.name: apply(placed.world_from_box, panel.triangles)[..., 2]
            for panel in placed.panels
            if panel.name.startswith("side")
        }
        (lower,) = (name for name, heights in below.items() if heights.max() < placed.box.board_m + 0.001)
        assert min(heights.min() for heights in below.values()) == pytest.approx(0.0002, abs=1e-6)
        sides.add(lower)
    assert len(sides) >= 3


def test_no_wall_stands_between_the_camera_and_the_scene() -> None:
    """Walls are drawn without asking where the camera will be: the first four of these scenes had one before it."""
    walls = 0
    seen_through = [("large", 24), ("medium", 24), ("small", 24), ("small", 94)]
    for category, index in [*seen_through, *(("pizza", index) for index in range(60))]:
        scene = draw_scene(np.random.default_rng((31, index)), category, kinect_camera(), None, clutter=False)
        camera = inverse(scene.camera_from_world)[:3, 3]
        for body in scene.bodies:
            corners = body.triangles.reshape(-1, 3)
            if len(body.triangles) != 2 or np.ptp(corners[:, 2]) < 1.0:
                continue
            normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
            assert (normal @ (camera - corners[0])) * (normal @ -corners[0]) > 0, (category, index)
            walls += 1
    assert walls > 10


def test_a_wall_beside_the_sensor_does_not_stand_between_its_projector_and_the_scene() -> None:
    """Nothing was lit in this frame: it held no reading."""
    assert np.isfinite(make_frame("pizza", 8001, 89).points).all(axis=1).mean() > 0.5
