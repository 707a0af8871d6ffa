"""The clouds of benchmarks/front_end.py are those that its text says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from planes.frames import hd_camera, make_fused, make_samples

from boxwright.simulation import make_frame
from boxwright.simulation.frames import kinect_camera


def test_vga_frames_are_those_of_synth(tmp_path: Path) -> None:
    samples = make_samples(tmp_path, 2, 9, kinect_camera())
    assert [sample.path.name for sample in samples] == ["small_0000.f32", "medium_0001.f32"]
    frame = make_frame("medium", 9, 1)
    assert np.array_equal(np.fromfile(samples[1].path, np.float32).reshape(-1, 3), frame.points, equal_nan=True)
    assert samples[1].truth == frame.truth
    assert np.array_equal(samples[1].faces, frame.faces)


def test_the_finer_camera_sees_the_same_scene_in_three_times_the_pixels(tmp_path: Path) -> None:
    (sample,) = make_samples(tmp_path, 1, 9, hd_camera())
    points = np.fromfile(sample.path, np.float32).reshape(720, 1280, 3)
    assert (sample.width, sample.height) == (1280, 720)
    row, column = 500, 900
    x, y, z = points[row, column]
    camera = hd_camera()
    np.testing.assert_allclose(
        [x / z, y / z], [(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy], rtol=1e-5
    )
    vga = kinect_camera()
    np.testing.assert_allclose((camera.cx - -0.5) / camera.fx, (vga.cx - -0.5) / vga.fx)


def test_fused_clouds_stand_upright_and_are_as_many_points_as_asked(tmp_path: Path) -> None:
    (sample,) = make_fused(tmp_path, 1, 31001, 200_000)
    points = np.fromfile(sample.path, np.float32).reshape(-1, 3)
    assert points.shape == (200_000, 3)
    assert np.isfinite(points).all()
    assert np.mean(np.abs(points[:, 2]) < 0.02) > 0.2, "the support lies at z = 0"
    azimuths = np.histogram(np.arctan2(points[:, 1], points[:, 0]), 8)[0] / len(points)
    assert azimuths.min() > 0.03, "seen from all around"
