"""What scenes hold, over many of them: the whole range that was asked for occurs."""

from collections import Counter

import numpy as np
import pytest

from boxwright import _core
from boxwright.simulation.boxes import OpenBox
from boxwright.simulation.drawing import CATEGORIES, NONE, draw_scene
from boxwright.simulation.frames import kinect_camera
from boxwright.simulation.kinds import KINDS
from boxwright.simulation.poses import apply
from boxwright.simulation.scene import Scene
from boxwright.simulation.views import up_in_camera

SCENES = 350


@pytest.fixture(scope="module")
def scenes() -> list[Scene]:
    camera = kinect_camera()
    kinds = (*CATEGORIES, NONE)
    return [
        draw_scene(np.random.default_rng((41, k)), kinds[k % len(kinds)], camera, None, clutter=True)
        for k in range(SCENES)
    ]


@pytest.fixture(scope="module")
def boxes(scenes: list[Scene]) -> list[OpenBox]:
    return [placed.box for scene in scenes for placed in scene.boxes]


def test_every_kind_occurs(boxes: list[OpenBox]) -> None:
    seen = {(box.category, box.variant) for box in boxes}
    assert seen == {(category, variant) for category, variants in KINDS.items() for variant in variants}
    assert len(seen) >= 15
    assert tuple(KINDS) == ("small", "medium", "large", "carton", "cake", "pizza")


def test_flaps_open_from_nearly_closed_to_hanging(boxes: list[OpenBox]) -> None:
    degrees = np.degrees([flap.angle_rad for box in boxes for flap in box.flaps if flap])
    shares, _ = np.histogram(degrees, [-15, 5, 20, 60, 130, 190, 240])
    assert shares.sum() == len(degrees)
    assert shares[0] >= 8
    assert (shares[1:] / len(degrees) > 0.04).all()


def test_boxes_are_imperfect(boxes: list[OpenBox]) -> None:
    flaps = [flap for box in boxes for flap in box.flaps if flap]
    assert np.mean([flap.bend_rad != 0 for flap in flaps]) > 0.5
    assert np.mean([flap.taper_start_m != flap.taper_end_m for flap in flaps]) > 0.3
    assert sum(flap.tuck is not None for flap in flaps) > 40
    assert np.mean([box.rack_rad != 0 for box in boxes]) > 0.4
    assert np.mean([max(map(abs, box.bulges_m)) > 0.001 for box in boxes]) > 0.3
    four = [box for box in boxes if box.variant in ("rsc", "tall_rsc", "overlap", "gap", "uneven")]
    assert 0.1 < np.mean([None in box.flaps for box in four]) < 0.4
    assert min(box.board_m for box in boxes) > 0.0009
    assert max(box.board_m for box in boxes) <= 0.007


def test_views_are_from_everywhere(scenes: list[Scene]) -> None:
    elevation = np.degrees([np.arcsin(-up_in_camera(scene.camera_from_world)[2]) for scene in scenes])
    assert 19.9 < elevation.min() < 25
    assert elevation.max() > 86
    assert 40 < np.median(elevation) < 60


def test_some_boxes_are_cut_by_the_frame(scenes: list[Scene]) -> None:
    camera = kinect_camera()

    def is_cut(scene: Scene) -> bool:
        points = np.concatenate([placed.triangles_world().reshape(-1, 3) for placed in scene.boxes])
        x, y, z = apply(scene.camera_from_world, points).T
        u, v = camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy
        return bool(u.min() < 0 or v.min() < 0 or u.max() > camera.width or v.max() > camera.height)

    assert 0.02 < np.mean([is_cut(scene) for scene in scenes if scene.boxes]) < 0.25


def test_one_to_three_boxes_stand_centimetres_apart(scenes: list[Scene]) -> None:
    counts = Counter(len(scene.boxes) for scene in scenes)
    assert counts[0] == SCENES // 7
    assert min(counts[k] for k in (1, 2, 3)) >= 15
    apart = []
    for scene in scenes:
        if len(scene.boxes) != 2:
            continue
        bodies = [placed.triangles_world() for placed in scene.boxes]
        groups = np.repeat(np.arange(2, dtype=np.int32), [len(body) for body in bodies])
        gaps = (0.009, 0.02, 0.05, 0.1)
        apart.append([bool(_core.close_surface_groups(np.concatenate(bodies), groups, gap)) for gap in gaps])
    closer = np.mean(apart, axis=0)
    assert closer[0] == 0
    assert closer[1] > 0.02
    assert closer[3] > 0.8


def test_surroundings_and_things_vary(scenes: list[Scene]) -> None:
    bodies = [[body.triangles for body in scene.bodies] for scene in scenes]
    tables = np.mean([min(body[..., 2].min() for body in one) < -0.69 for one in bodies])
    walls = np.mean([max(body[..., 2].max() for body in one) > 1.1 for one in bodies])
    tilted = np.mean([abs(placed.world_from_box[2, 2]) < 0.9999 for scene in scenes for placed in scene.boxes])
    assert 0.3 < tables < 0.5
    assert 0.2 < walls < 0.5
    assert 0.04 < tilted < 0.2
    assert max(len(one) for one in bodies) - min(len(one) for one in bodies) >= 8


def test_clutter_can_be_left_out() -> None:
    scene = draw_scene(np.random.default_rng(3), "medium", kinect_camera(), 2, clutter=False)
    assert len(scene.boxes) == 2
    assert all(body.triangles.shape[0] <= 12 for body in scene.bodies)
