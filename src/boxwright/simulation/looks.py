"""One scene seen from several places, as a camera on an arm sees it, with the truth of each frame."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.conditions import DRAWN, Conditions
from boxwright.simulation.drawing import draw_scene
from boxwright.simulation.frames import Frame, check_request, frame_name, kinect_camera, render
from boxwright.simulation.poses import apply, inverse
from boxwright.simulation.scene import Scene
from boxwright.simulation.views import look_at, position_in_world
from boxwright.types import Camera

Array = NDArray[np.float64]
Rng = np.random.Generator

TURN_DEG = (30.0, 110.0)
"""How far round the boxes the camera goes for another look, to either side."""
ELEVATION_DEG = (30.0, 75.0)
LEAST_SHARE = 0.5
"""Another look shows this share at least of the pixels on boards that the first shows: nothing stands before it."""
TRIES = 12


class Look(msgspec.Struct, frozen=True, eq=False):
    """A frame, and where its camera stood: base_from_camera (4, 4), metres, the base being the scene's world."""

    frame: Frame
    base_from_camera: Array


def make_looks(
    category: str,
    seed: int,
    index: int = 0,
    views: int = 3,
    *,
    boxes: int | None = None,
    clutter: bool = True,
    conditions: Conditions = DRAWN,
) -> tuple[Look, ...]:
    """The scene of `make_frame` with these arguments from its own camera, and from `views` - 1 further places.

    The first frame is that of `make_frame`, bit for bit; truth k is told in frame k's coordinates. Raises ValueError as
    `make_frame` does, and where there is no view.
    """
    check_request(category, seed, index, boxes)
    conditions.check(category)
    if views < 1:
        raise ValueError(f"views is {views}; must be 1 or more")
    camera = kinect_camera()
    rng = np.random.default_rng((seed, index))
    scene = draw_scene(rng, category, camera, boxes, clutter=clutter, conditions=conditions)
    name = frame_name(category, index)
    looks = [_look(scene, camera, int(rng.integers(2**63)), name, conditions.noise)]
    for view in range(1, views):
        rng = np.random.default_rng((seed, index, view))
        looks.append(_another(rng, scene, camera, looks[0].frame, f"{name}_view{view}", conditions.noise))
    return tuple(looks)


def _look(scene: Scene, camera: Camera, seed: int, name: str, noise: float) -> Look:
    return Look(render(scene, camera, seed, name, noise), inverse(scene.camera_from_world))


def _another(rng: Rng, scene: Scene, camera: Camera, first: Frame, name: str, noise: float) -> Look:
    """The first of some draws from which the boxes are seen; of none that is, the one that sees most of them."""
    wanted = LEAST_SHARE * _on_boards(first)
    best: Look | None = None
    for _ in range(TRIES):
        moved = msgspec.structs.replace(scene, camera_from_world=_draw_place(rng, scene))
        look = _look(moved, camera, int(rng.integers(2**63)), name, noise)
        if best is None or _on_boards(look.frame) > _on_boards(best.frame):
            best = look
        if _on_boards(best.frame) >= wanted:
            break
    assert best is not None
    return best


def _draw_place(rng: Rng, scene: Scene) -> Array:
    """camera_from_world of a place round the boxes, about as far from them as the scene's own camera."""
    middle = _middle(scene)
    way = position_in_world(scene.camera_from_world) - middle
    turn = np.radians(rng.uniform(*TURN_DEG)) * rng.choice((-1.0, 1.0))
    elevation = np.radians(rng.uniform(*ELEVATION_DEG))
    distance_m = float(np.linalg.norm(way)) * rng.uniform(0.85, 1.1)
    target = middle + np.append(rng.normal(0.0, 0.04, 2), 0.0)
    azimuth = float(np.arctan2(way[1], way[0]) + turn)
    return look_at(target, azimuth, elevation, distance_m, np.radians(rng.normal(0.0, 4.0)))


def _middle(scene: Scene) -> Array:
    """Of the boxes; of the things where there is none."""
    solids = [box.triangles_world() for box in scene.boxes]
    if not solids:
        ahead = apply(inverse(scene.camera_from_world), np.array([0.0, 0.0, 1.2]))
        return np.append(ahead[:2], 0.1)
    points = np.concatenate(solids).reshape(-1, 3)
    return np.asarray((points.min(axis=0) + points.max(axis=0)) / 2.0)


def _on_boards(frame: Frame) -> int:
    return sum(part.visible_px for part in frame.truth.parts)
