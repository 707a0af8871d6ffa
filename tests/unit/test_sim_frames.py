"""Simulated frames: the same bits for a seed, and a truth that fits the readings."""

import os
import subprocess
import sys

import numpy as np
import pytest

from boxwright.simulation import CATEGORIES, NONE, Frame, make_frame
from boxwright.simulation.drawing import draw_scene
from boxwright.simulation.frames import kinect_camera, render

FINGERPRINT = """
import hashlib
from boxwright.simulation import make_frame
frame = make_frame("medium", 7, 3)
print(hashlib.sha256(frame.points.tobytes() + frame.labels.tobytes() + frame.colors.tobytes()).hexdigest())
"""


@pytest.fixture(scope="module")
def frames() -> list[Frame]:
    return [make_frame(category, 11, index) for index, category in enumerate(2 * CATEGORIES)]


def test_same_bits_on_one_thread_and_on_many() -> None:
    prints = {
        subprocess.run(
            [sys.executable, "-c", FINGERPRINT],
            env=os.environ | {"RAYON_NUM_THREADS": threads},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for threads in ("1", "2", "5")
    }
    assert len(prints) == 1


def test_frames_of_a_sequence_differ() -> None:
    first, second = make_frame("small", 3, 0), make_frame("small", 3, 1)
    assert not np.array_equal(first.points, second.points, equal_nan=True)


def test_labels_are_of_readings_and_are_counted(frames: list[Frame]) -> None:
    for frame in frames:
        assert np.isfinite(frame.points[frame.labels > 0]).all()
        counts = np.bincount(frame.labels, minlength=len(frame.truth.parts) + 1)[1:]
        assert counts.tolist() == [part.visible_px for part in frame.truth.parts]


def test_readings_lie_on_their_panels(frames: list[Frame]) -> None:
    """Within half a board, bulge, bend and noise of the plane of the true corners."""
    checked = 0
    for frame in frames:
        for label, part in enumerate(frame.truth.parts, start=1):
            points = frame.points[frame.labels == label].astype(np.float64)
            if len(points) < 400:
                continue
            corners = np.array(part.corners)
            normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
            offset = np.abs((points - corners[0]) @ (normal / np.linalg.norm(normal)))
            reach = np.linalg.norm(corners[2] - corners[1])
            near = 0.008 + 0.003 * points[:, 2].mean() ** 2 + (0.17 * reach if part.parent else 0.0)
            assert np.median(offset) < near, (frame.truth.name, part.name)
            checked += 1
    assert checked >= 60


def test_flat_panels_turn_as_the_truth_says() -> None:
    """A plane through the readings of a flat board nearer than 1.8 m has the true normal, but for bulge and noise."""
    camera = kinect_camera()
    errors_deg = []
    for k in range(18):
        scene = draw_scene(np.random.default_rng((8, k)), CATEGORIES[k % 6], camera, None, clutter=True)
        frame = render(scene, camera, k, "frame")
        for label, part in enumerate(frame.truth.parts, start=1):
            flap = scene.boxes[part.box].box.flaps[int(part.name[-1])] if part.parent else None
            points = frame.points[frame.labels == label].astype(np.float64)
            if len(points) < 3000 or points[:, 2].mean() > 1.8 or (flap is not None and flap.bend_rad != 0):
                continue
            corners = np.array(part.corners)
            normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
            fitted = np.linalg.svd(points - points.mean(axis=0), full_matrices=False)[2][2]
            errors_deg.append(np.degrees(np.arccos(min(1.0, abs(normal @ fitted) / np.linalg.norm(normal)))))
    assert len(errors_deg) >= 35
    assert np.median(errors_deg) < 0.5
    assert max(errors_deg) < 2.0


def test_corners_are_ordered_as_the_formats_say(frames: list[Frame]) -> None:
    checked = 0
    for frame in frames:
        for box in frame.truth.boxes:
            parts = {part.name: part for part in frame.truth.parts if part.box == box.index}
            base = np.array(parts["base"].corners)
            up = np.array(frame.truth.up)
            inside = base.mean(axis=0) + 0.5 * box.dims[2] * np.array(up)
            for k in range(4):
                side = np.array(parts[f"side{k}"].corners)
                np.testing.assert_allclose(side[[3, 2]], base[[k, (k + 1) % 4]], atol=1e-9)
                axis, box_up = side[1] - side[0], side[0] - side[3]
                inward = np.cross(box_up, axis)
                assert inward @ (inside - side.mean(axis=0)) > 0
                checked += _check_flap(parts, k, axis, inward, box_up)
    assert checked >= 25


def _check_flap(parts: dict, k: int, axis: np.ndarray, inward: np.ndarray, box_up: np.ndarray) -> int:
    """Its angle, measured from its corners about the hinge axis by the right-hand rule."""
    flap = parts.get(f"flap{k}")
    if flap is None:
        return 0
    corners = np.array(flap.corners)
    assert (corners[1] - corners[0]) @ axis > 0
    reach = (corners[2] + corners[3] - corners[0] - corners[1]) / 2
    reach -= axis * (reach @ axis) / (axis @ axis)
    angle = np.degrees(np.arctan2(reach @ box_up / np.linalg.norm(box_up), reach @ inward / np.linalg.norm(inward)))
    assert (angle - flap.angle_deg + 180) % 360 - 180 == pytest.approx(0, abs=0.01)
    return 1


def test_a_frame_without_boxes_has_no_parts() -> None:
    frame = make_frame(NONE, 5)
    assert not frame.truth.boxes
    assert not frame.truth.parts
    assert not frame.labels.any()


@pytest.mark.parametrize(("category", "boxes", "word"), [("crate", None, "category"), ("small", 4, "boxes")])
def test_arguments_that_do_not_fit_are_refused(category: str, boxes: int | None, word: str) -> None:
    with pytest.raises(ValueError, match=word):
        make_frame(category, 0, boxes=boxes)


def test_boxes_on_a_side_are_drawn_until_their_flaps_keep_clear_of_the_ground() -> None:
    """Thirty draws of this one do not."""
    (box,) = make_frame("lying", 9405, 7, boxes=1).truth.boxes
    assert box.variant == "on_its_side"
