"""The conventions of docs/formats.md hold in the truth of the shared labelled frames, which others made."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import read_set

Vector = NDArray[np.float64]


def unit(vector: Vector) -> Vector:
    return vector / np.linalg.norm(vector)


def across(direction: Vector, axis: Vector) -> Vector:
    """The unit component of a direction that stands across an axis."""
    return unit(direction - (direction @ axis) * axis)


def test_sides_run_counter_clockwise_and_stand_on_the_base(shared_dir: Path) -> None:
    count = 0
    for panels, _, up in boxes(shared_dir):
        base = panels["base"]
        for k in range(4):
            side = panels[f"side{k}"]
            inward = np.cross(up, side[1] - side[0])
            assert inward @ (base.mean(axis=0) - side.mean(axis=0)) > 0
            np.testing.assert_allclose(side[[3, 2]], base[[k, (k + 1) % 4]], atol=1e-9)
            count += 1
    assert count == 16 * 4


def test_the_right_hand_about_the_hinge_opens_a_flap(shared_dir: Path) -> None:
    count = 0
    for panels, told, _ in boxes(shared_dir):
        for name, flap in panels.items():
            if not name.startswith("flap"):
                continue
            side = panels[f"side{name[4]}"]
            axis = unit(flap[1] - flap[0])
            upwards = across(side[0] - side[3], axis)
            inwards = np.cross(upwards, axis)
            pointing = across(flap[2] + flap[3] - flap[0] - flap[1], axis)
            angle_deg = math.degrees(math.atan2(pointing @ upwards, pointing @ inwards))
            difference_deg = (angle_deg - told[name] + 180.0) % 360.0 - 180.0
            assert abs(difference_deg) < 1e-9
            count += 1
    assert count > 50


def test_a_tuck_grows_towards_the_inside_of_the_closed_box(shared_dir: Path) -> None:
    count = 0
    for panels, told, _ in boxes(shared_dir):
        for name, tuck in panels.items():
            if not name.startswith("tuck"):
                continue
            flap = panels[f"flap{name[4]}"]
            np.testing.assert_array_equal(tuck[:2], flap[[3, 2]])
            axis = unit(flap[1] - flap[0])
            onwards = across(flap[2] + flap[3] - flap[0] - flap[1], axis)
            outer_face = np.cross(axis, onwards)
            pointing = across(tuck[2] + tuck[3] - tuck[0] - tuck[1], axis)
            angle_deg = math.degrees(math.atan2(-(pointing @ outer_face), pointing @ onwards))
            assert abs(angle_deg - told[name]) < 1e-9
            count += 1
    assert count == 6


def boxes(shared_dir: Path) -> list[tuple[dict[str, Vector], dict[str, float], Vector]]:
    """For each true box: corners (4, 3) of its panels and angles (degrees) of what turns, by name; its frame's up."""
    found = []
    for frame in read_set(shared_dir / "data" / "labelled"):
        for box in frame.truth.boxes:
            parts = [part for part in frame.truth.parts if part.box == box.index]
            corners = {part.name: np.array(part.corners) for part in parts}
            angles_deg = {part.name: part.angle_deg for part in parts if part.angle_deg is not None}
            found.append((corners, angles_deg, np.array(frame.truth.up)))
    return found
