"""benchmarks/gallery/how_seen.py: of a flap the first way of being seen that holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from gallery.how_seen import (
    CUT,
    FROM_EDGE,
    HIDDEN,
    IN_PLANE,
    PLAINLY,
    SHUT,
    TOO_FEW,
    seen_flaps,
    sight_of,
)

from boxwright.simulation import write_set
from boxwright.types.truth import Camera, TruePart, Truth
from support.command import boxwright

CAMERA = Camera(fx=500.0, fy=500.0, cx=320.0, cy=240.0, width=640, height=480)
PIXELS = 100 * 50
"""Of a flap of 0.2 x 0.1 m at a metre, square to the camera."""


def flap(tilt_deg: float, x_m: float = 0.0, angle_deg: float = 150.0, visible_px: int = PIXELS) -> TruePart:
    """A flap before the camera, turned about its long side; 90 degrees show its edge."""
    away, down = np.sin(np.radians(tilt_deg)) * 0.1, np.cos(np.radians(tilt_deg)) * 0.1
    corners = tuple(
        (x_m + x, y * down - down / 2.0, 1.0 + y * away - away / 2.0) for x, y in ((0, 0), (0.2, 0), (0.2, 1), (0, 1))
    )
    return TruePart(0, "flap0", "side0", False, angle_deg, corners, visible_px)


@pytest.mark.parametrize(
    ("part", "panels", "expected"),
    [
        (flap(0.0), 6, PLAINLY),
        (flap(0.0), 2, TOO_FEW),
        (flap(0.0, x_m=0.6), 2, TOO_FEW),
        (flap(0.0, x_m=0.6), 6, CUT),
        (flap(84.0, visible_px=450), 6, FROM_EDGE),
        (flap(80.0, visible_px=850), 6, PLAINLY),
        (flap(0.0, visible_px=PIXELS // 2 - 100), 6, HIDDEN),
        (flap(0.0, visible_px=PIXELS // 2 + 100), 6, PLAINLY),
        (flap(0.0, angle_deg=80.0), 6, IN_PLANE),
        (flap(0.0, angle_deg=76.0), 6, PLAINLY),
        (flap(0.0, angle_deg=-11.0), 6, SHUT),
        (flap(0.0, angle_deg=13.0), 6, PLAINLY),
    ],
)
def test_a_flap_is_seen_in_the_first_way_that_holds(part: TruePart, panels: int, expected: str) -> None:
    truth = Truth("one", "small", CAMERA, (0.0, -1.0, 0.0), (), (part,))
    assert sight_of(part, truth, panels) == expected


def test_flaps_in_the_cloud_are_those_of_the_evaluation(tmp_path: Path) -> None:
    write_set(tmp_path / "set", 6, 77)
    told = tmp_path / "told.json"
    ran = boxwright("evaluate", tmp_path / "set", "-o", told, "--jobs", "1")
    assert ran.status == 0, ran
    evaluation = json.loads(told.read_text())
    flaps = list(seen_flaps(tmp_path / "set", evaluation))
    boxes = [box for frame in evaluation["frames"] for box in frame["boxes"]]
    assert len(flaps) == sum(box["flaps_in_cloud"] for box in boxes) > 6
    lost = sum(box["flaps_in_cloud"] - box["flaps_right"] for box in boxes)
    assert sum(flap.is_lost for flap in flaps) == lost
