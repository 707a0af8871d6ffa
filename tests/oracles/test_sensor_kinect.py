"""The simulated sensor against published figures of the first Kinect.

Khoshelham and Elberink, Sensors 12 (2012) 1437: random error 1.425e-3 z^2 m, depth steps of 2.85e-3 z^2 m (z in m).
Nguyen, Izadi, Lovell, 3DIMPVT 2012: axial noise 0.0012 + 0.0019 (z - 0.4)^2 m up to 60 degrees.
The model aims at about 0.08 px of disparity in all, slow ripples included, which a fitted plane would swallow in part:
that is 1.4 times the first source's error at every distance, and 0.7 (near) to 1.3 (far) times the second's.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from boxwright import _core

FX, _, CX, CY, WIDTH, HEIGHT = _core.kinect_camera()
BASELINE_M = 0.075


def wall(depth_m: float, tilt_deg: float = 0.0, half_m: float = 6.0) -> NDArray[np.float64]:
    """A square across the optical axis, turned about the vertical (y)."""
    tilt = np.radians(tilt_deg)
    across = half_m * np.array([np.cos(tilt), 0, np.sin(tilt)])
    down = np.array([0, half_m, 0])
    middle = np.array([0, 0, depth_m])
    a, b, c, d = middle - across - down, middle + across - down, middle + across + down, middle - across + down
    return np.array([[a, b, c], [a, c, d]])


def look(triangles: NDArray[np.float64], ids: list[int], seed: int = 1) -> tuple[NDArray, NDArray]:
    """Depth and ids as images."""
    colors = np.full((len(triangles), 3), 200, np.uint8)
    points, labels, _ = _core.simulate_depth(triangles, np.array(ids, np.int32), colors, seed)
    return points[:, 2].astype(np.float64).reshape(HEIGHT, WIDTH), labels.reshape(HEIGHT, WIDTH)


DEPTHS_M = (0.7, 1.0, 1.4, 1.8, 2.3, 2.9, 3.5)


@pytest.fixture(scope="module")
def noise_m() -> NDArray[np.float64]:
    return np.array([np.std(look(wall(z), [1, 1])[0] - z) for z in DEPTHS_M])


def test_noise_grows_with_the_square_of_the_distance(noise_m: NDArray) -> None:
    power, _ = np.polyfit(np.log(DEPTHS_M), np.log(noise_m), 1)
    assert power == pytest.approx(2.0, abs=0.08)


def test_noise_is_of_the_published_size(noise_m: NDArray) -> None:
    depths = np.array(DEPTHS_M)
    khoshelham = noise_m / (1.425e-3 * depths**2)
    nguyen = noise_m / (0.0012 + 0.0019 * (depths - 0.4) ** 2)
    assert khoshelham.min() > 1.0
    assert khoshelham.max() < 1.5
    assert nguyen.min() > 0.6
    assert nguyen.max() < 1.5


def test_steps_are_of_the_published_size() -> None:
    for z in (1.0, 2.0, 3.0):
        levels = np.unique(look(wall(z), [1, 1])[0])
        at = np.abs(levels - z).argmin()
        step = (levels[at + 1] - levels[at - 1]) / 2
        assert step == pytest.approx(2.85e-3 * z**2, rel=0.03)


def test_noise_is_white_patchy_and_rippling() -> None:
    """Neighbours agree in part, pixels twenty apart a little, pixels 250 apart not at all."""
    disparity = [FX * BASELINE_M / look(wall(1.5), [1, 1], seed)[0] for seed in range(8)]
    residual = np.array(disparity) - FX * BASELINE_M / 1.5
    assert residual.std() == pytest.approx(0.083, abs=0.006)

    def correlation(lag: int) -> float:
        return float((residual[:, :, lag:] * residual[:, :, :-lag]).mean() / residual.var())

    assert 0.30 < correlation(1) < 0.75
    assert 0.05 < correlation(20) < 0.25
    assert abs(correlation(250)) < 0.05


def test_readings_are_lost_at_grazing_angles_only() -> None:
    def lost(tilt_deg: float) -> float:
        z = look(wall(1.5, tilt_deg), [1, 1])[0]
        return float(np.isnan(z[:, WIDTH // 2 - 8 : WIDTH // 2 + 8]).mean())

    assert lost(0) == 0.0
    assert lost(65) < 0.01
    assert 0.1 < lost(80) < 0.5
    assert lost(88) > 0.7


def test_range_is_kept() -> None:
    assert np.isnan(look(wall(0.40), [1, 1])[0]).all()
    assert np.isnan(look(wall(4.7), [1, 1])[0]).all()
    assert np.isfinite(look(wall(0.5), [1, 1])[0]).all()


def test_edges_are_shadowed_ragged_and_fly() -> None:
    """A plate 0.2 m across, 1 m away, before a wall at 2 m."""
    depth, labels = look(np.concatenate([wall(2.0), wall(1.0, half_m=0.1)]), [1, 1, 2, 2])
    rows = slice(HEIGHT // 2 - 40, HEIGHT // 2 + 40)
    plate = depth[rows] < 1.2
    shadow = np.isnan(depth[rows])
    right_edge = CX + FX * 0.1
    assert shadow.sum() / 80 == pytest.approx(FX * BASELINE_M * (1 / 1.0 - 1 / 2.0), abs=2.0)
    assert np.nonzero(shadow)[1].min() > right_edge - 3
    ends = [np.nonzero(row)[0].max() for row in plate]
    assert 2 <= len(set(ends)) <= 8
    flying = (depth > 1.1) & (depth < 1.9)
    around = 2 * 4 * FX * 0.1
    assert 0.02 * around < flying.sum() < 0.3 * around
    assert not labels[flying].any()
    assert (labels[np.isfinite(depth) & ~flying] > 0).mean() > 0.999


@pytest.mark.parametrize(
    ("triangles", "ids", "camera", "word"),
    [
        (np.zeros((2, 3, 2)), [1, 1], None, "triangles"),
        (wall(1.0), [1], None, "surface_ids"),
        (wall(float("nan")), [1, 1], None, "not finite"),
        (wall(1.0), [1, 1], (-1.0, 500.0, 320.0, 240.0, 640, 480), "fx"),
        (wall(1.0), [1, 1], (500.0, 500.0, 320.0, 240.0, 0, 480), "image"),
    ],
)
def test_what_does_not_fit_is_refused(triangles: NDArray, ids: list[int], camera: tuple | None, word: str) -> None:
    colors = np.zeros((len(triangles), 3), np.uint8)
    with pytest.raises(ValueError, match=word):
        _core.simulate_depth(triangles, np.array(ids, np.int32), colors, 1, camera)


def test_other_intrinsics_give_other_images() -> None:
    camera = (300.0, 310.0, 100.0, 80.0, 200, 160)
    points, labels, colors = _core.simulate_depth(
        wall(1.0), np.ones(2, np.int32), np.full((2, 3), 200, np.uint8), 3, camera
    )
    assert points.shape == colors.shape == (200 * 160, 3)
    assert labels.shape == (200 * 160,)
    u, v = np.tile(np.arange(200), 160), np.repeat(np.arange(160), 200)
    np.testing.assert_allclose(points[:, 0] / points[:, 2] * 300 + 100, u, atol=1e-3)
    np.testing.assert_allclose(points[:, 1] / points[:, 2] * 310 + 80, v, atol=1e-3)
