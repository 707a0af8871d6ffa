"""Simulated scenes that are looked at twice: what a panel shows from another place."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.conditions import DRAWN, Conditions
from boxwright.simulation.drawing import draw_scene
from boxwright.simulation.frames import Frame, kinect_camera, render
from boxwright.simulation.poses import apply, inverse
from boxwright.simulation.scene import Scene
from boxwright.types import Cloud, Object

ORIGIN = (0.0, 0.0, 0.0)
NEAR_M = 0.04
"""Two top edges nearer than this are of one side."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class SeenScene:
    """A scene and its frame from its own camera."""

    scene: Scene
    frame: Frame

    @property
    def cloud(self) -> Cloud:
        return cloud_of(self.frame)

    def seen_at(self, place: Array, target: Array) -> Frame:
        """The frame of a camera that stands at `place` and looks at `target`, both in the first camera's frame."""
        camera_from_world = looking(place, target, np.array(self.frame.truth.up)) @ self.scene.camera_from_world
        moved = Scene(self.scene.category, self.scene.boxes, self.scene.bodies, camera_from_world)
        return render(moved, kinect_camera(), 1, "again")


def cloud_of(frame: Frame) -> Cloud:
    return Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=ORIGIN)


def draw(category: str, seed: int, index: int, boxes: int = 1, conditions: Conditions = DRAWN) -> SeenScene:
    """A scene by its seed, with its frame."""
    rng, camera = np.random.default_rng((seed, index)), kinect_camera()
    scene = draw_scene(rng, category, camera, boxes, clutter=False, conditions=conditions)
    return SeenScene(scene, render(scene, camera, int(rng.integers(2**63)), "first", conditions.noise))


def looking(place: Array, target: Array, up: Array) -> Array:
    """new_from_old of a camera at `place` that looks at `target`, its image's down away from `up`."""
    ahead = (target - place) / np.linalg.norm(target - place)
    right = np.cross(ahead, up)
    if np.linalg.norm(right) < 1e-6:
        right = np.cross(ahead, np.array([0.0, 0.3, 1.0]))
    right /= np.linalg.norm(right)
    old_from_new = np.eye(4)
    old_from_new[:3, :3] = np.stack([right, np.cross(ahead, right), ahead], axis=1)
    old_from_new[:3, 3] = place
    return inverse(old_from_new)


def true_names(found: Object, frame: Frame, box: int) -> dict[str, str] | None:
    """What each of an object's parts is called in the truth of a box; None where it does not lie on that box."""
    if found.pose is None:
        return None
    tops = {p.name: _top(p.corners) for p in frame.truth.parts if p.box == box and p.name.startswith("side")}
    names = {"base": "base"}
    for k in range(4):
        corners = found.part(f"side_{k}").corners
        if corners is None:
            return None
        distance = {name: float(np.linalg.norm(top - _top(corners))) for name, top in tops.items()}
        nearest = min(distance, key=lambda name: distance[name])
        if distance[nearest] > NEAR_M:
            return None
        for kind in ("side", "flap", "tuck"):
            names[f"{kind}_{k}"] = nearest.replace("side", kind)
    return names if len(set(names.values())) == len(names) else None


def visible_px(frame: Frame, box: int, name: str) -> int | None:
    """Pixels that show a panel; None where the truth has no such panel."""
    return next((p.visible_px for p in frame.truth.parts if (p.box, p.name) == (box, name)), None)


def middle_of(frame: Frame, box: int, name: str) -> Array:
    """Of a true panel, the frame's own frame."""
    corners = next(p.corners for p in frame.truth.parts if (p.box, p.name) == (box, name))
    return np.asarray(np.mean(corners, axis=0))


def _top(corners: object) -> Array:
    return np.asarray(np.array(corners)[:2].mean(axis=0))


def moved(transform: Array, points: Array) -> Array:
    return np.asarray(apply(transform, points))
