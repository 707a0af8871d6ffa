"""A scene through the camera: a frame with its truth."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.simulation.drawing import CATEGORIES, NONE, draw_scene
from boxwright.simulation.panels import Panel
from boxwright.simulation.poses import apply
from boxwright.simulation.scene import PlacedBox, Scene
from boxwright.simulation.views import up_in_camera
from boxwright.types import Camera, TrueBox, TruePart, Truth


class Frame(msgspec.Struct, frozen=True, eq=False):
    """An organized frame: point v * width + u is pixel (u, v). Optical frame (x right, y down, z forward), metres."""

    points: NDArray[np.float32]
    """(N, 3), NaN where there is no reading."""
    width: int
    height: int
    colors: NDArray[np.uint8]
    """(N, 3) red, green, blue."""
    labels: NDArray[np.uint16]
    """(N,) index of the part + 1, 0 for none."""
    truth: Truth


def kinect_camera() -> Camera:
    """Intrinsics of the simulated camera."""
    fx, fy, cx, cy, width, height = _core.kinect_camera()
    return Camera(fx, fy, cx, cy, width, height)


def make_frame(
    category: str, seed: int, index: int = 0, *, boxes: int | None = None, clutter: bool = True, name: str | None = None
) -> Frame:
    """Frame `index` of the endless sequence that `seed` names; frames do not depend on one another.

    `category` is one of small, medium, large, carton, cake, pizza, or none for a frame without an open box; `boxes`
    is the number of open boxes, drawn where None; it says nothing to none. Same arguments, same bits.

    Raises ValueError when the category is not known or the number of boxes is not 1, 2 or 3.
    """
    check_request(category, seed, index, boxes)
    camera = kinect_camera()
    rng = np.random.default_rng((seed, index))
    scene = draw_scene(rng, category, camera, boxes, clutter=clutter)
    sensor_seed = int(rng.integers(2**63))
    return render(scene, camera, sensor_seed, name or frame_name(category, index))


def frame_name(category: str, index: int) -> str:
    return f"{category}_{index:04d}"


def check_request(category: str, seed: int, index: int, boxes: int | None) -> None:
    """Raises ValueError, saying what would be right, when `make_frame` could not use these."""
    known = (*CATEGORIES, NONE)
    if category not in known:
        raise ValueError(f"category is {category!r}; must be one of {', '.join(known)}")
    if seed < 0 or index < 0:
        raise ValueError(f"seed is {seed}, index {index}; both must be 0 or more")
    if boxes is not None and not 1 <= boxes <= 3:
        raise ValueError(f"boxes is {boxes}; must be 1, 2 or 3")


def render(scene: Scene, camera: Camera, seed: int, name: str) -> Frame:
    """What the camera reports of a scene, and the truth about it. Same arguments, same bits."""
    panels = [(index, placed, panel) for index, placed in enumerate(scene.boxes) for panel in placed.panels]
    solids = [
        (apply(placed.world_from_box, panel.triangles), placed.box.color, k + 1)
        for k, (_, placed, panel) in enumerate(panels)
    ]
    solids += [(body.triangles, body.color, 0) for body in scene.bodies]
    sizes = [len(triangles) for triangles, _, _ in solids]
    triangles = apply(scene.camera_from_world, np.concatenate([triangles for triangles, _, _ in solids]))
    points, ids, colors = _core.simulate_depth(
        triangles,
        np.repeat(np.array([label for _, _, label in solids], dtype=np.int32), sizes),
        np.repeat(np.array([color for _, color, _ in solids], dtype=np.uint8), sizes, axis=0),
        seed,
        (camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height),
    )
    counts = np.bincount(ids, minlength=len(panels) + 1)[1:]
    parts = [_true_part(scene, *panel, int(count)) for panel, count in zip(panels, counts, strict=True)]
    boxes = [_true_box(index, placed) for index, placed in enumerate(scene.boxes)]
    truth = Truth(name, scene.category, camera, up_in_camera(scene.camera_from_world), tuple(boxes), tuple(parts))
    return Frame(points, camera.width, camera.height, colors, ids.astype(np.uint16), truth)


def _true_box(index: int, placed: PlacedBox) -> TrueBox:
    box = placed.box
    return TrueBox(index, box.category, box.variant, (box.length_m, box.width_m, box.height_m))


def _true_part(scene: Scene, box: int, placed: PlacedBox, panel: Panel, visible_px: int) -> TruePart:
    corners = apply(scene.camera_from_world @ placed.world_from_box, panel.corners)
    first, second, third, fourth = ((float(x), float(y), float(z)) for x, y, z in corners)
    angle_deg = None if panel.angle_rad is None else float(np.degrees(panel.angle_rad))
    return TruePart(box, panel.name, panel.parent, panel.extra, angle_deg, (first, second, third, fourth), visible_px)
