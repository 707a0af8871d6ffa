"""Labelled frames made of random boxes: a truth, its labels, and the answer that is exactly right."""

from __future__ import annotations

from dataclasses import dataclass, replace

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import FrameScore, score_frame
from boxwright.types import Camera, Joint, Object, Part, TrueBox, TruePart, Truth
from support.random_models import Angles, BoxSpec, panels, random_object

CAMERA = Camera(fx=575.8, fy=575.8, cx=319.5, cy=239.5, width=640, height=480)


@dataclass(frozen=True)
class Scene:
    """A frame's answer and its truth; labels are (N,), one for each point."""

    objects: tuple[Object, ...]
    object_labels: NDArray[np.int16]
    part_labels: NDArray[np.int16]
    truth: Truth
    truth_labels: NDArray[np.uint16]

    def score(self) -> FrameScore:
        return score_frame(self.objects, self.object_labels, self.part_labels, self.truth, self.truth_labels)


def perfect_scene(
    boxes: list[tuple[BoxSpec, Angles, dict[str, int]]], category: str = "small", background: int = 5000
) -> Scene:
    """Boxes with so many readings on each panel (absent names: 3000), answered without a fault."""
    objects, true_boxes, true_parts = [], [], []
    columns = [np.tile([-1, -1, 0], (background, 1))]
    for b, (spec, angles, readings) in enumerate(boxes):
        perfect = _perfect_object(spec, angles)
        objects.append(perfect)
        true_boxes.append(TrueBox(index=b, category=category, variant="rsc", dims=_dims(spec)))
        index_of = {part.name: j for j, part in enumerate(perfect.parts)}
        for name, corners in panels(spec, angles).items():
            count = readings.get(name, 3000)
            true_parts.append(_true_part(b, name, corners, angles, count))
            columns.append(np.tile([b, index_of[name], len(true_parts)], (count, 1)))
    table = np.concatenate(columns)
    truth = Truth("made_up", category, CAMERA, (0.0, 0.0, 1.0), tuple(true_boxes), tuple(true_parts))
    return Scene(
        tuple(objects), table[:, 0].astype(np.int16), table[:, 1].astype(np.int16), truth, table[:, 2].astype(np.uint16)
    )


def with_names_rotated(scene: Scene, k: int, rotation: int) -> Scene:
    """The same answer with object k told under another of its four rotations."""
    objects = list(scene.objects)
    objects[k] = rotate_names(objects[k], rotation)
    return replace(scene, objects=tuple(objects))


def rotate_names(model_object: Object, rotation: int) -> Object:
    """Side k becomes side k - rotation, with all that hangs on it; length and width change places when it is odd."""

    def name(old: str) -> str:
        kind, separator, rest = old.partition("_")
        return f"{kind}_{(int(rest[0]) - rotation) % 4}{rest[1:]}" if separator else old

    def joint(old: Joint) -> Joint:
        return msgspec.structs.replace(old, name=name(old.name), parent=name(old.parent), child=name(old.child))

    dims = model_object.dimensions
    return msgspec.structs.replace(
        model_object,
        parts=tuple(msgspec.structs.replace(part, name=name(part.name)) for part in model_object.parts),
        joints=tuple(joint(old) for old in model_object.joints),
        dimensions=(dims[1], dims[0], dims[2]) if dims and rotation % 2 else dims,
    )


def _perfect_object(spec: BoxSpec, angles: Angles) -> Object:
    """All panels observed, the base too, with the box's dimensions."""
    made = random_object(replace(spec, base_known=True), angles)
    parts = tuple(_numbered(part) for part in made.parts)
    return msgspec.structs.replace(made, parts=parts, dimensions=_dims(spec))


def _numbered(part: Part) -> Part:
    return msgspec.structs.replace(part, points=3000 if part.observed else 0)


def _dims(spec: BoxSpec) -> tuple[float, float, float]:
    length, width = np.linalg.norm(spec.floor[1] - spec.floor[0]), np.linalg.norm(spec.floor[2] - spec.floor[1])
    return float(length), float(width), spec.height


def _true_part(box: int, name: str, corners: NDArray[np.float64], angles: Angles, count: int) -> TruePart:
    kind, _, number = name.partition("_")
    a, b, c, d = ((float(p[0]), float(p[1]), float(p[2])) for p in corners)
    return TruePart(
        box=box,
        name=kind + number,
        parent={"flap": f"side{number}", "tuck": f"flap{number}"}.get(kind),
        extra=kind == "tuck",
        angle_deg=float(np.degrees(angles[name])) if name in angles else None,
        corners=(a, b, c, d),
        visible_px=count,
    )
