"""What is drawn over an image: rectangles of segments, panels of models."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.patheffects import withStroke

from boxwright.figures.palette import FAINT, INK, SIDE, SIDES, of_group, of_part, of_segment
from boxwright.figures.view import Array, View
from boxwright.perception import Perception
from boxwright.types import Object, Part, Segment

INSET_PX = 1.5
"""Rectangles are drawn so much smaller that two that meet are both seen."""


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


def draw_sides(axes: Axes, view: View, segments: tuple[Segment, ...]) -> None:
    """The sides of each segment's rectangle, drawn by what ends the segment there, far ones first."""
    for segment in _far_to_near(view, segments):
        outline = view.project(np.array(segment.rectangle))
        inward = outline.mean(axis=0) - outline
        outline = outline + inward * (INSET_PX / np.maximum(np.linalg.norm(inward, axis=1), INSET_PX)[:, None])
        for k, kind in enumerate(segment.edges):
            colour, dashes = SIDES[kind]
            (u0, v0), (u1, v1) = outline[k], outline[(k + 1) % 4]
            axes.plot([u0, u1], [v0, v1], color="white", linewidth=3.2, alpha=0.7, scalex=False, scaley=False)
            axes.plot([u0, u1], [v0, v1], color=colour, linestyle=dashes, linewidth=1.7, scalex=False, scaley=False)


def draw_numbers(axes: Axes, view: View, segments: tuple[Segment, ...]) -> None:
    """Each segment's number at the middle of its hull, in its group's colour."""
    number = {id(segment): k for k, segment in enumerate(segments)}
    for segment in _far_to_near(view, segments):
        middle = view.project(np.array(segment.hull).mean(axis=0)[None, :])[0]
        write_number(axes, middle, number[id(segment)], of_group(segment.group))


def write_number(axes: Axes, place: Array, number: int, colour: str) -> None:
    """A number on a coloured disc."""
    disc = {"boxstyle": "circle,pad=0.18", "facecolor": colour, "edgecolor": "white", "linewidth": 0.8}
    axes.text(float(place[0]), float(place[1]), str(number), ha="center", va="center", fontsize=7.5, color=INK,
              bbox=disc, clip_on=True, zorder=5)  # fmt: skip


def _far_to_near(view: View, segments: tuple[Segment, ...]) -> list[Segment]:
    """The segments whose rectangles lie before the camera."""
    shown = [segment for segment in segments if view.has_before_it(np.array(segment.rectangle))]
    return sorted(shown, key=lambda segment: -float(view.distance(np.array(segment.rectangle)).mean()))


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
