"""What is drawn over an image: rectangles of segments, panels of models."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke

from boxwright.figures.palette import FAINT, INK, SIDE, of_part, of_segment
from boxwright.figures.view import View
from boxwright.perception import Perception
from boxwright.types import Object, Part


def draw_rectangles(axes: Axes, view: View, perception: Perception) -> None:
    """Each segment's minimum bounding rectangle, in the segment's colour, far ones first."""
    rectangles = perception.rectangles
    far_to_near = np.argsort(-np.array([view.distance(r).mean() for r in rectangles]), kind="stable")
    for s in far_to_near:
        if not view.has_before_it(rectangles[s]):
            continue
        outline = view.project(rectangles[s])
        colour = of_segment(int(s))
        axes.add_patch(Polygon(outline, closed=True, facecolor=colour, alpha=0.30, linewidth=0))
        axes.add_patch(Polygon(outline, closed=True, fill=False, edgecolor=colour, linewidth=1.8))


def draw_objects(axes: Axes, view: View, objects: tuple[Object, ...]) -> None:
    """The panels of all objects: sides dark, flaps and base light with the flaps' angles, hidden ones dashed."""
    placed = [(found, part, np.array(part.corners)) for found in objects for part in found.parts if part.corners]
    placed = [item for item in placed if view.has_before_it(item[2])]
    placed.sort(key=lambda item: (item[1].observed, -float(view.distance(item[2]).mean())))
    for _, part, corners in placed:
        _draw_panel(axes, part, view.project(corners))
    for found, part, corners in placed:
        angle_rad = next((joint.position for joint in found.joints if joint.child == part.name), None)
        if angle_rad is not None and part.observed:
            _write(axes, view.project(corners.mean(axis=0)[None, :])[0], f"{math.degrees(angle_rad):.0f}°")


def _draw_panel(axes: Axes, part: Part, outline: np.ndarray) -> None:
    if not part.observed:
        axes.add_patch(Polygon(outline, closed=True, fill=False, edgecolor=INK, linestyle=(0, (3, 3)), linewidth=0.8))
        return
    colour = of_part(part.name)
    edge = FAINT if colour == SIDE else INK
    axes.add_patch(Polygon(outline, closed=True, facecolor=colour, edgecolor=edge, alpha=0.88, linewidth=1.0))


def _write(axes: Axes, pixel: np.ndarray, text: str) -> None:
    halo = [withStroke(linewidth=2.2, foreground="white")]
    axes.text(
        float(pixel[0]),
        float(pixel[1]),
        text,
        ha="center",
        va="center",
        fontsize=8,
        color=INK,
        path_effects=halo,
        clip_on=True,
    )
