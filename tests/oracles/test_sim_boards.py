"""Boards and bodies of drawn scenes never pass through each other.

Independent of the simulator's own test: two closed surfaces cross exactly where an edge of one passes through a
triangle of the other, decided here by signs of tetrahedra's volumes.
"""

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from boxwright.simulation.drawing import CATEGORIES, NONE, draw_scene
from boxwright.simulation.frames import kinect_camera
from boxwright.simulation.panels import Panel
from boxwright.simulation.poses import apply
from boxwright.simulation.scene import PlacedBox, Scene

Array = NDArray[np.float64]

SCENES = 105


@pytest.fixture(scope="module")
def scenes() -> list[Scene]:
    camera = kinect_camera()
    kinds = (*CATEGORIES, NONE)
    return [
        draw_scene(np.random.default_rng((23, k)), kinds[k % len(kinds)], camera, None, clutter=True)
        for k in range(SCENES)
    ]


def edges(triangles: Array) -> Array:
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def spans_meet(a: Array, b: Array) -> bool:
    lo_a, hi_a, lo_b, hi_b = a.min((0, 1)), a.max((0, 1)), b.min((0, 1)), b.max((0, 1))
    return bool((lo_a < hi_b).all() and (lo_b < hi_a).all())


def volume(a: Array, b: Array, c: Array, d: Array) -> Array:
    return np.einsum("...i,...i", np.cross(b - a, c - a), d - a)


def segments_cross(segments: Array, triangles: Array) -> bool:
    """Does any segment (S, 2, 3) pass through the inside of any triangle (T, 3, 3)?"""
    p, q = segments[:, None, 0], segments[:, None, 1]
    a, b, c = (triangles[None, :, k] for k in range(3))
    around = np.stack([volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)])
    is_split = volume(a, b, c, p) * volume(a, b, c, q) < -1e-24
    return bool((is_split & ((around > 1e-12).all(0) | (around < -1e-12).all(0))).any())


def bodies_cross(a: Array, b: Array) -> bool:
    return spans_meet(a, b) and (segments_cross(edges(a), b) or segments_cross(edges(b), a))


def are_folded(a: Panel, b: Panel) -> bool:
    return (a.parent is None and b.parent is None) or b.parent == a.name or a.parent == b.name


def beyond_hinge(panel: Panel, distance_m: float) -> Array:
    """A flap's edges (S, 2, 3) from a distance to its hinge on."""
    start, end = panel.corners[:2]
    along = (end - start) / np.linalg.norm(end - start)
    segments = edges(panel.triangles)
    from_hinge = segments - start
    from_hinge -= (from_hinge @ along)[..., None] * along
    reach = np.linalg.norm(from_hinge, axis=-1)
    near, far = segments[np.arange(len(segments)), reach.argmin(1)], segments[np.arange(len(segments)), reach.argmax(1)]
    low, high = reach.min(1), reach.max(1)
    share = np.clip((distance_m - low) / np.maximum(high - low, 1e-9), 0, 1)[:, None]
    return np.stack([near + share * (far - near), far], axis=1)[high > distance_m]


def test_crossing_is_noticed() -> None:
    flat = np.array([[[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]])
    through = np.array([[[0.2, 0.2, -1], [0.3, 0.2, 1], [0.2, 0.3, 1]]])
    assert bodies_cross(flat, through)
    assert not bodies_cross(flat, through + np.array([0, 0, 1.5]))
    assert not bodies_cross(flat, through + np.array([2, 0, 0]))


def test_no_board_passes_through_another(scenes: list[Scene]) -> None:
    boxes = pairs = 0
    for scene in scenes:
        for placed in scene.boxes:
            boxes += 1
            for a, b in itertools.combinations(placed.panels, 2):
                if are_folded(a, b):
                    continue
                pairs += 1
                assert not bodies_cross(a.triangles, b.triangles), (placed.box, a.name, b.name)
    assert boxes >= 100
    assert pairs >= 2000


def test_no_flap_folds_back_through_what_it_hangs_on(scenes: list[Scene]) -> None:
    flaps = 0
    for scene in scenes:
        for placed in scene.boxes:
            named = {panel.name: panel for panel in placed.panels}
            for flap in placed.panels:
                if flap.parent is None:
                    continue
                flaps += 1
                free = beyond_hinge(flap, 3.5 * placed.box.board_m)
                assert not segments_cross(free, named[flap.parent].triangles), (placed.box, flap.name)
    assert flaps >= 250


def is_on_support(body: Array) -> bool:
    """Not the floor, a table, its legs or a wall."""
    return bool(np.ptp(body[..., 2]) > 0 and body[..., 2].min() >= -1e-9 and body[..., 2].max() < 1.5)


def solids(placed: PlacedBox) -> list[Array]:
    return [apply(placed.world_from_box, panel.triangles) for panel in placed.panels]


def test_nothing_passes_through_anything_else(scenes: list[Scene]) -> None:
    """Boxes against boxes, things against boxes and against things; nothing sinks into the support."""
    pairs = 0
    for scene in scenes:
        things = [body.triangles for body in scene.bodies if is_on_support(body.triangles)]
        groups = [solids(placed) for placed in scene.boxes] + [[thing] for thing in things]
        for first, second in itertools.combinations(groups, 2):
            pairs += 1
            assert not any(bodies_cross(a, b) for a in first for b in second), scene.category
        for placed in scene.boxes:
            assert placed.triangles_world()[..., 2].min() >= -1e-9
    assert pairs >= 1200
