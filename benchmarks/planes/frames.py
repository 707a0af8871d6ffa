"""What is segmented: simulated frames as raw files, their truth kept in memory."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.parallel import ordered_map, processors
from boxwright.simulation import CATEGORIES
from boxwright.simulation.drawing import draw_scene
from boxwright.simulation.frames import Frame, frame_name, kinect_camera, render
from boxwright.simulation.poses import apply, inverse
from boxwright.simulation.scene import Scene
from boxwright.simulation.views import look_at
from boxwright.types import Camera, Truth

SUFFIX = ".f32"
VIEW_AZIMUTHS = 5
FUSED_ELEVATION_RAD = 0.9
FUSED_DISTANCE_M = 1.6


@dataclass(frozen=True)
class Sample:
    """A cloud on disk, float32 x, y, z; `truth` and `faces` (N,) None where it is timed and not scored."""

    path: Path
    width: int
    height: int
    truth: Truth | None = None
    faces: NDArray[np.uint16] | None = None


def hd_camera() -> Camera:
    """1280 x 720: the Kinect's lens before twice as fine a sensor, cut above and below."""
    vga = kinect_camera()
    height = 720
    cut = (2 * vga.height - height) / 2
    return Camera(2 * vga.fx, 2 * vga.fy, 2 * vga.cx + 0.5, 2 * vga.cy + 0.5 - cut, 2 * vga.width, height)


def make_samples(folder: Path, count: int, seed: int, camera: Camera) -> list[Sample]:
    """Frames 0 .. count of a seed, the six categories in turn; with the Kinect's camera those of `boxwright synth`."""
    folder.mkdir(parents=True, exist_ok=True)

    def make(index: int) -> Sample:
        frame = _frame(index, seed, camera)
        path = folder / f"{frame.truth.name}{SUFFIX}"
        frame.points.tofile(path)
        return Sample(path, frame.width, frame.height, frame.truth, frame.faces)

    return list(ordered_map(make, range(count), processors()))


def make_fused(folder: Path, count: int, seed: int, readings: int) -> list[Sample]:
    """Unorganized clouds of `readings` points, each five views of one scene from around it; metres, z up."""
    folder.mkdir(parents=True, exist_ok=True)
    samples = []
    for index in range(count):
        scene, sensor_seed = _scene(index, seed, kinect_camera())
        points = np.concatenate([_view(scene, sensor_seed + k, k) for k in range(VIEW_AZIMUTHS)])
        keep = np.linspace(0, len(points) - 1, readings).astype(np.int64)
        path = folder / f"fused_{index:04d}{SUFFIX}"
        points[keep].tofile(path)
        samples.append(Sample(path, readings, 1))
    return samples


def _scene(index: int, seed: int, camera: Camera) -> tuple[Scene, int]:
    rng = np.random.default_rng((seed, index))
    scene = draw_scene(rng, CATEGORIES[index % len(CATEGORIES)], camera, None, clutter=True)
    return scene, int(rng.integers(2**63))


def _frame(index: int, seed: int, camera: Camera) -> Frame:
    scene, sensor_seed = _scene(index, seed, camera)
    return render(scene, camera, sensor_seed, frame_name(scene.category, index))


def _view(scene: Scene, seed: int, k: int) -> NDArray[np.float32]:
    """The readings of one of the views, world frame."""
    azimuth = 2 * np.pi * k / VIEW_AZIMUTHS
    camera_from_world = look_at(np.array([0.0, 0.0, 0.1]), azimuth, FUSED_ELEVATION_RAD, FUSED_DISTANCE_M, 0.0)
    seen = render(msgspec.structs.replace(scene, camera_from_world=camera_from_world), kinect_camera(), seed, "view")
    finite = seen.points[np.isfinite(seen.points).all(axis=1)]
    return apply(inverse(camera_from_world), finite.astype(np.float64)).astype(np.float32)
