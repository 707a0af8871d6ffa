"""A scene through the camera: a frame with its truth."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.simulation.conditions import DRAWN, Conditions
from boxwright.simulation.drawing import CATEGORIES, FURTHER_CATEGORIES, NONE, draw_scene
from boxwright.simulation.faces import flat_faces, unit_normals
from boxwright.simulation.panels import Panel
from boxwright.simulation.poses import apply
from boxwright.simulation.scene import PlacedBox, Scene
from boxwright.simulation.views import up_in_camera
from boxwright.types import Camera, TrueBox, TrueFace, TruePart, Truth

Ids = NDArray[np.int32]


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
    faces: NDArray[np.uint16]
    """(N,) as `labels` on panels, then the index of the face + 1 + the number of parts; 0 for none and where round."""
    truth: Truth


def kinect_camera() -> Camera:
    """Intrinsics of the simulated camera."""
    fx, fy, cx, cy, width, height = _core.kinect_camera()
    return Camera(fx, fy, cx, cy, width, height)


def make_frame(
    category: str,
    seed: int,
    index: int = 0,
    *,
    boxes: int | None = None,
    clutter: bool = True,
    conditions: Conditions = DRAWN,
    name: str | None = None,
) -> Frame:
    """Frame `index` of the endless sequence that `seed` names; frames do not depend on one another.

    `category` is one of small, medium, large, carton, cake, pizza, or none for a frame without an open box; `boxes`
    is the number of open boxes, drawn where None; it says nothing to none. `conditions` sets more that is else drawn.
    Same arguments, same bits.

    Raises ValueError when the category is not known, the number of boxes is not 1, 2 or 3, or no frame is so.
    """
    check_request(category, seed, index, boxes)
    conditions.check(category)
    camera = kinect_camera()
    rng = np.random.default_rng((seed, index))
    scene = draw_scene(rng, category, camera, boxes, clutter=clutter, conditions=conditions)
    sensor_seed = int(rng.integers(2**63))
    return render(scene, camera, sensor_seed, name or frame_name(category, index), conditions.noise)


def frame_name(category: str, index: int) -> str:
    return f"{category}_{index:04d}"


def check_request(category: str, seed: int, index: int, boxes: int | None) -> None:
    """Raises ValueError, saying what would be right, when `make_frame` could not use these."""
    known = (*CATEGORIES, *FURTHER_CATEGORIES, NONE)
    if category not in known:
        raise ValueError(f"category is {category!r}; must be one of {', '.join(known)}")
    if seed < 0 or index < 0:
        raise ValueError(f"seed is {seed}, index {index}; both must be 0 or more")
    if boxes is not None and not 1 <= boxes <= 3:
        raise ValueError(f"boxes is {boxes}; must be 1, 2 or 3")


def render(scene: Scene, camera: Camera, seed: int, name: str, noise: float = 1.0) -> Frame:
    """What the camera reports of a scene, with `noise` times the Kinect's, and the truth. Same arguments, same bits."""
    panels = [(index, placed, panel) for index, placed in enumerate(scene.boxes) for panel in placed.panels]
    solids = [
        (apply(placed.world_from_box, panel.triangles), placed.box.color, np.full(len(panel.triangles), k + 1))
        for k, (_, placed, panel) in enumerate(panels)
    ]
    solids += [(body.triangles, body.color, ids) for body, ids in zip(scene.bodies, _body_ids(scene), strict=True)]
    triangles = apply(scene.camera_from_world, np.concatenate([triangles for triangles, _, _ in solids]))
    surface_ids = np.concatenate([ids for _, _, ids in solids]).astype(np.int32)
    points, ids, colors = _core.simulate_depth(
        triangles,
        surface_ids,
        np.repeat(np.array([color for _, color, _ in solids], np.uint8), [len(t) for t, _, _ in solids], axis=0),
        seed,
        (camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height),
        noise,
    )
    counts = np.bincount(ids, minlength=len(panels) + 1)
    parts = [_true_part(scene, *panel, int(count)) for panel, count in zip(panels, counts[1:], strict=False)]
    faces, seen = _seen_faces(ids, len(panels))
    true_faces = [_true_face(triangles[surface_ids == k], int(counts[k])) for k in seen]
    boxes = [_true_box(index, placed) for index, placed in enumerate(scene.boxes)]
    up = up_in_camera(scene.camera_from_world)
    truth = Truth(name, scene.category, camera, up, tuple(boxes), tuple(parts), tuple(true_faces))
    labels = np.where(ids <= len(panels), ids, 0).astype(np.uint16)
    return Frame(points, camera.width, camera.height, colors, labels, faces, truth)


def _body_ids(scene: Scene) -> list[NDArray[np.int64]]:
    """For each body without panels the id of each triangle: of its flat face, after the panels'; 0 where round."""
    last = sum(len(placed.panels) for placed in scene.boxes)
    ids = []
    for body in scene.bodies:
        faces = flat_faces(body.triangles)
        ids.append(np.where(faces < 0, 0, faces + last + 1))
        last += int(faces.max()) + 1
    return ids


def _seen_faces(ids: Ids, panels: int) -> tuple[NDArray[np.uint16], list[int]]:
    """Ids with those beyond the panels' numbered anew, without gaps; and which ids these were."""
    seen = [int(k) for k in np.unique(ids) if k > panels]
    new = np.arange(max([panels, *seen]) + 1)
    new[seen] = panels + 1 + np.arange(len(seen))
    return new[ids].astype(np.uint16), seen


def _true_face(triangles: NDArray[np.float64], visible_px: int) -> TrueFace:
    """The plane of a face, camera frame, its normal towards the camera."""
    normal = unit_normals(triangles[:1])[0]
    distance = float(normal @ triangles[0, 0])
    x, y, z = (float(c) for c in (-normal if distance > 0 else normal))
    return TrueFace((x, y, z), -abs(distance), visible_px)


def _true_box(index: int, placed: PlacedBox) -> TrueBox:
    box = placed.box
    return TrueBox(index, box.category, box.variant, (box.length_m, box.width_m, box.height_m))


def _true_part(scene: Scene, box: int, placed: PlacedBox, panel: Panel, visible_px: int) -> TruePart:
    corners = apply(scene.camera_from_world @ placed.world_from_box, panel.corners)
    first, second, third, fourth = ((float(x), float(y), float(z)) for x, y, z in corners)
    angle_deg = None if panel.angle_rad is None else float(np.degrees(panel.angle_rad))
    return TruePart(box, panel.name, panel.parent, panel.extra, angle_deg, (first, second, third, fourth), visible_px)
