"""Small made-up scenes with known answers, and inputs that have none."""

import numpy as np
import pytest

from boxwright.perception import perceive
from boxwright.types import Cloud

FOCAL_PX, WIDTH, HEIGHT = 290.0, 320, 240


def organized(points: np.ndarray) -> Cloud:
    """An organized cloud (H, W, 3) seen from the origin."""
    flat = np.ascontiguousarray(points.reshape(-1, 3), dtype=np.float32)
    return Cloud(points=flat, width=points.shape[1], height=points.shape[0], viewpoint=(0.0, 0.0, 0.0))


def unorganized(points: np.ndarray) -> Cloud:
    """A cloud (N, 3) of which nobody knows the viewpoint."""
    return Cloud(points=np.ascontiguousarray(points, dtype=np.float32), width=len(points), height=1)


def tray(rng: np.random.Generator, *, floor: bool) -> np.ndarray:
    """Readings of a 40 x 30 x 20 cm open box, z up, 1 mm noise, on a floor of 1.4 m or on nothing."""
    parts = [rng.uniform([-0.2, -0.15, 0.004], [0.2, 0.15, 0.004], (6000, 3))]
    for axis, half in ((0, 0.2), (1, 0.15)):
        for side in (-half, half):
            wall = rng.uniform([-0.2, -0.15, 0.004], [0.2, 0.15, 0.2], (5000, 3))
            wall[:, axis] = side
            parts.append(wall)
    if floor:
        ground = rng.uniform([-0.7, -0.7, 0.0], [0.7, 0.7, 0.0], (60000, 3))
        parts.append(ground[(np.abs(ground[:, 0]) > 0.2) | (np.abs(ground[:, 1]) > 0.15)])
    points = np.concatenate(parts)
    return points + rng.normal(0.0, 0.001, points.shape)


@pytest.mark.parametrize("floor", [True, False])
def test_open_box_has_four_walls_and_a_base(floor: bool) -> None:
    seen = perceive(unorganized(tray(np.random.default_rng(1), floor=floor)), planes="ransac")
    assert seen.up @ [0, 0, 1] > np.cos(np.radians(0.5))
    assert (seen.support_plane is not None) == floor
    assert len(seen) == 5
    assert set(seen.groups) == {0}
    level = np.abs(seen.normals @ [0, 0, 1])
    assert np.sum(level > 0.99) == 1
    assert np.sum(level < 0.05) == 4
    base = int(np.argmax(level))
    sides = np.sort([np.linalg.norm(seen.rectangles[base, k + 1] - seen.rectangles[base, k]) for k in range(2)])
    assert sides == pytest.approx([0.3, 0.4], abs=0.035)


def test_labels_counts_and_rectangles_agree() -> None:
    points = tray(np.random.default_rng(2), floor=True)
    seen = perceive(unorganized(points), planes="ransac")
    assert seen.labels.shape == (len(points),)
    counts = np.bincount(seen.labels[seen.labels >= 0], minlength=len(seen))
    assert np.array_equal(counts, seen.point_counts)
    for s in range(len(seen)):
        offsets = points[seen.labels == s].astype(np.float32) @ seen.normals[s] - seen.distances[s]
        assert np.sqrt(np.mean(offsets**2)) == pytest.approx(seen.rms[s], rel=1e-3)
        corners = seen.rectangles[s]
        assert corners @ seen.normals[s] == pytest.approx(np.full(4, seen.distances[s]), abs=1e-6)
        assert corners[0] + corners[2] == pytest.approx(corners[1] + corners[3], abs=1e-9)
        assert seen.hulls[s] @ seen.normals[s] == pytest.approx(
            np.full(len(seen.hulls[s]), seen.distances[s]), abs=1e-6
        )


def test_unknown_setting_is_named() -> None:
    cloud = unorganized(tray(np.random.default_rng(3), floor=True))
    with pytest.raises(ValueError, match="cluster_gap_mm"):
        perceive(cloud, cluster_gap_mm=3.0)


def test_given_up_is_taken() -> None:
    seen = perceive(unorganized(tray(np.random.default_rng(4), floor=True)), up=(0.0, 0.1, 2.0))
    assert seen.up @ [0, 0, 1] > 0.999
    assert seen.support_plane is not None


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_no_readings_is_refused(value: float) -> None:
    with pytest.raises(ValueError, match="no finite readings among 12 points"):
        perceive(organized(np.full((3, 4, 3), value)))


@pytest.mark.parametrize("shape", [(5, 2), (6, 3)])
def test_wrong_shapes_are_refused(shape: tuple[int, int]) -> None:
    from boxwright import _core

    with pytest.raises(ValueError, match="shape"):
        _core.perceive(np.zeros(shape, np.float32), 5, 1)


def test_scenes_without_planes() -> None:
    rng = np.random.default_rng(5)
    direction = rng.normal(size=(20000, 3))
    ball = 0.1 * direction / np.linalg.norm(direction, axis=1, keepdims=True) + [0.0, 0.0, 1.0]
    answers = {
        "one point": perceive(unorganized(np.ones((1, 3)))),
        "all one point": perceive(unorganized(np.ones((5000, 3)))),
        "1 x 1": perceive(organized(np.ones((1, 1, 3)))),
        "line": perceive(unorganized(np.linspace([0, 0, 1], [1, 1, 1], 5000))),
        "noise": perceive(unorganized(rng.uniform(-1, 1, (20000, 3)))),
        "ball": perceive(unorganized(ball)),
    }
    assert {name: len(seen) for name, seen in answers.items() if name not in ("noise", "ball")} == {
        "one point": 0,
        "all one point": 0,
        "1 x 1": 0,
        "line": 0,
    }
    assert len(answers["noise"]) <= 5
    assert all(len(seen.labels) > 0 and np.linalg.norm(seen.up) == pytest.approx(1) for seen in answers.values())


def test_support_seen_from_below_is_refused() -> None:
    points = np.ascontiguousarray(tray(np.random.default_rng(6), floor=True), dtype=np.float32)
    with pytest.raises(ValueError, match=r"looks away from the viewpoint.*--frame opengl"):
        perceive(Cloud(points=points, width=len(points), height=1, viewpoint=(0.0, 0.0, -2.0)))


def test_corner_of_a_bare_room_asks_for_up() -> None:
    rng = np.random.default_rng(7)
    faces = [np.where(np.arange(3) == k, 0.0, rng.uniform(0, 1.5, (20000, 3))) for k in range(3)]
    points = np.concatenate(faces) + rng.normal(0, 0.001, (60000, 3))
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    with pytest.raises(ValueError, match="--up x,y,z"):
        perceive(unorganized(points @ turn.T))
    told = perceive(unorganized(points @ turn.T), up=tuple(turn[:, 1]))
    assert told.up @ turn[:, 1] > 0.999
