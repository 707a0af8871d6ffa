"""The CRF of a template as a graph, with the parts that were found."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, FancyArrowPatch

from boxwright import _core
from boxwright.figures.palette import FAINT, INK, SIDE, of_part
from boxwright.types import Object

Place = tuple[float, float]

NODE_RADIUS = 0.115
"""Of a node, where the graph's outermost ring has radius 1."""


def draw_graph(axes: Axes, template: _core.Template, found: Object | None, centre: Place, radius: float) -> None:
    """A node for each part, an edge for each pair that a relation ties; what was found is filled.

    Without an object the bare graph. Nodes carry the part's initial and number.
    The first class stands in the middle or on a ring, the others on rings around it.
    """
    seen = {part.name for part in found.parts if part.observed} if found else set()
    places = _places(template, centre, radius)
    for a, b in template.edges:
        both = template.parts[a] in seen and template.parts[b] in seen
        axes.add_patch(_edge(places[a], places[b], centre, both))
    for name, place in zip(template.parts, places, strict=True):
        _draw_node(axes, name, place, NODE_RADIUS * radius, name in seen)


def _places(template: _core.Template, centre: Place, radius: float) -> list[Place]:
    """Where each part's node stands: a ring for each class, a class of one in the middle where it is the first."""
    classes = list(dict.fromkeys(template.classes))
    members = {name: [i for i, own in enumerate(template.classes) if own == name] for name in classes}
    middle = len(members[classes[0]]) == 1
    rings = len(classes) - middle
    places: list[Place] = [centre] * len(template.parts)
    for ring, name in enumerate(classes[middle:], start=1):
        for k, part in enumerate(members[name]):
            angle = math.radians(-90.0 + 360.0 * k / len(members[name]))
            reach = radius * ring / rings
            places[part] = (centre[0] + reach * math.cos(angle), centre[1] + reach * math.sin(angle))
    return places


def _edge(start: Place, end: Place, centre: Place, found: bool) -> FancyArrowPatch:
    """A line; one that would run over the middle bends around it."""
    across = np.hypot((start[0] + end[0]) / 2 - centre[0], (start[1] + end[1]) / 2 - centre[1]) < 1e-9
    return FancyArrowPatch(
        start,
        end,
        arrowstyle="-",
        connectionstyle=f"arc3,rad={0.35 if across else 0.0}",
        color=INK if found else FAINT,
        linewidth=1.5 if found else 0.9,
        linestyle="-" if found else (0, (2, 2)),
        zorder=1,
    )


def _draw_node(axes: Axes, name: str, place: Place, radius: float, found: bool) -> None:
    fill = of_part(name) if found else "white"
    axes.add_patch(Circle(place, radius, facecolor=fill, edgecolor=INK if found else FAINT, linewidth=1.1, zorder=2))
    colour = "white" if fill == SIDE else INK if found else FAINT
    kind, _, number = name.partition("_")
    axes.text(*place, f"{kind[0]}{number}", ha="center", va="center", fontsize=7, color=colour,
              zorder=3)  # fmt: skip
