"""How the camera sees a flap: facts of the truth alone, whatever was told of it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import list_set, read_entry
from boxwright.types.truth import Camera, TruePart, Truth

LEAST_READINGS = 400
"""A panel of fewer readings is none in the cloud (docs/formats.md, "The figures of merit")."""
LEAST_PANELS = 3
EDGE_DEG, SHOWN_SHARE, PLANE_DEG = 8.0, 0.5, 12.0
SIDE_DEG = 90.0

TOO_FEW, CUT, FROM_EDGE, HIDDEN = (
    "its box shows one panel or two",
    "it is cut off by the image's edge",
    f"from its edge, at less than {EDGE_DEG:g} degrees",
    "less than half of it shows",
)
IN_PLANE, SHUT, PLAINLY = (
    f"within {PLANE_DEG:g} degrees of its side's plane",
    f"within {PLANE_DEG:g} degrees of shut",
    "plainly",
)
SIGHTS = (TOO_FEW, CUT, FROM_EDGE, HIDDEN, IN_PLANE, SHUT, PLAINLY)
"""The first that holds of a flap is its own."""

Array = NDArray[np.float64]


class SeenFlap(msgspec.Struct, frozen=True):
    """A flap in the cloud; `box` and `name` as the truth has them, `sight` one of SIGHTS."""

    frame: str
    box: int
    name: str
    sight: str
    is_lost: bool
    is_box_missed: bool


def seen_flaps(folder: Path, evaluation: dict[str, Any]) -> Iterator[SeenFlap]:
    """All flaps in the clouds of a set, frame by frame."""
    told = {frame["name"]: frame for frame in evaluation["frames"]}
    for entry in list_set(folder):
        frame = told.get(entry.name)
        if frame is None:
            continue
        truth = read_entry(entry).truth
        for box in frame["boxes"]:
            missed = {panel.replace("_", "") for panel in box["missed"]}
            for part in truth.parts:
                if part.box != box["box"] or not is_asked_for(part):
                    continue
                sight = sight_of(part, truth, box["panels_in_cloud"])
                yield SeenFlap(
                    entry.name, part.box, part.name, sight, part.name in missed, is_box_missed=box["object"] is None
                )


def is_asked_for(part: TruePart) -> bool:
    """Is it a flap with enough readings?"""
    return part.name.startswith("flap") and not part.extra and part.visible_px >= LEAST_READINGS


def sight_of(part: TruePart, truth: Truth, panels_in_cloud: int) -> str:
    """How a flap is seen, of a box that shows so many panels."""
    if panels_in_cloud < LEAST_PANELS:
        return TOO_FEW
    corners = np.array(part.corners)
    outline = None if truth.camera is None else pixels(corners, truth.camera)
    if outline is None or truth.camera is None or not is_inside(outline, truth.camera):
        return CUT
    if edge_deg(corners) < EDGE_DEG:
        return FROM_EDGE
    if part.visible_px < SHOWN_SHARE * area(outline):
        return HIDDEN
    if part.angle_deg is not None and abs(part.angle_deg - SIDE_DEG) < PLANE_DEG:
        return IN_PLANE
    if part.angle_deg is not None and abs(part.angle_deg) < PLANE_DEG:
        return SHUT
    return PLAINLY


def pixels(corners: Array, camera: Camera) -> Array | None:
    """Pixels (N, 2) of points (N, 3) of the camera's frame, z forwards; None where one lies behind it."""
    if corners[:, 2].min() <= 0.0:
        return None
    return corners[:, :2] / corners[:, 2:] * [camera.fx, camera.fy] + [camera.cx, camera.cy]


def is_inside(outline: Array, camera: Camera) -> bool:
    """Whether the image has all of an outline."""
    return bool(np.all(outline >= 0.0) and np.all(outline <= [camera.width - 1, camera.height - 1]))


def edge_deg(corners: Array) -> float:
    """The angle between a panel and the way that its middle is seen from, at the camera's frame's origin."""
    normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
    middle = corners.mean(axis=0)
    sine = abs(normal @ middle) / (np.linalg.norm(normal) * np.linalg.norm(middle))
    return float(np.degrees(np.arcsin(min(1.0, sine))))


def area(outline: Array) -> float:
    """Of a polygon (N, 2)."""
    x, y = outline.T
    return float(abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2.0)
