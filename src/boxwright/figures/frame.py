"""One frame in the paper's five columns: what was seen, segments, rectangles, matched model, graph."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from boxwright.figures.canvas import save_png, show
from boxwright.figures.graph import draw_graph
from boxwright.figures.images import faint, seen_image, segment_image
from boxwright.figures.overlays import draw_objects, draw_rectangles
from boxwright.figures.palette import INK
from boxwright.figures.view import view_of
from boxwright.figures.window import Window, window_of
from boxwright.models import TEMPLATE_NAMES, load_template
from boxwright.pipeline import Inferred
from boxwright.types import Cloud

INCHES = (19.0, 3.35)
GRAPH_PLACES = {1: ((0.0, 0.0),), 2: ((-1.25, 0.0), (1.25, 0.0)), 3: ((-1.25, 1.2), (1.25, 1.2), (0.0, -1.2))}
"""Centres of so many graphs, each of radius 1."""

GRAPH_REACH = {1: 1.15, 2: 1.85, 3: 2.4}
"""Half of the column's height where so many graphs stand in it."""

MOST_GRAPHS = 3


def save_frame_figure(
    cloud: Cloud,
    inferred: Inferred,
    path: str | PathLike[str],
    templates: tuple[str | Path, ...] = TEMPLATE_NAMES,
) -> None:
    """Draws a cloud and what was inferred of it as PNG; equal arguments give equal bytes.

    `templates` are those that `infer` was given. Raises ValueError and OSError as `load_template` does, and OSError
    where the picture cannot be written.
    """
    figure = frame_figure(cloud, inferred, templates)
    save_png(figure, path)


def frame_figure(cloud: Cloud, inferred: Inferred, templates: tuple[str | Path, ...] = TEMPLATE_NAMES) -> Figure:
    """The figure itself, to be drawn on any canvas."""
    figure = Figure(figsize=INCHES, facecolor="white")
    columns = figure.subplots(1, 5)
    figure.subplots_adjust(left=0.006, right=0.994, top=0.90, bottom=0.02, wspace=0.03)
    view = view_of(cloud, inferred.perception)
    window = window_of(view, inferred)
    kind, seen = seen_image(cloud, view)
    background = faint(seen, cloud, view)

    show(columns[0], seen, f"{inferred.model.source.file}: {kind}")
    _frame(columns[0], window)
    segments = segment_image(view, inferred.perception, background)
    show(columns[1], segments, f"{len(inferred.perception)} plane segments", window)
    show(columns[2], background, "bounding rectangles", window)
    draw_rectangles(columns[2], view, inferred.perception)
    show(columns[3], background, _names(inferred), window)
    draw_objects(columns[3], view, inferred.model.objects)
    _draw_graphs(columns[4], inferred, templates)
    return figure


def _frame(axes: Axes, window: Window) -> None:
    """The window that the other columns show."""
    corner = (window.left, window.top)
    size = (window.right - window.left, window.bottom - window.top)
    axes.add_patch(Rectangle(corner, *size, fill=False, edgecolor="white", linewidth=1.2, linestyle=(0, (4, 3))))


def _names(inferred: Inferred) -> str:
    objects = inferred.model.objects
    if not objects:
        return "no object"
    return ", ".join(f"{found.template} {found.score:.2f}" for found in objects[:MOST_GRAPHS])


def _draw_graphs(axes: Axes, inferred: Inferred, templates: tuple[str | Path, ...]) -> None:
    """The graph of each object, with what was found of it; without an object that of the first template, bare."""
    loaded = {template.name: template for template in map(load_template, templates)}
    shown = inferred.model.objects[:MOST_GRAPHS]
    more = len(inferred.model.objects) - len(shown)
    axes.set_title("graph: parts found" + (f" ({more} more objects)" if more else ""), fontsize=10, color=INK,
                   loc="left", pad=5)  # fmt: skip
    reach = GRAPH_REACH[max(len(shown), 1)]
    axes.set_xlim(-reach * 4 / 3, reach * 4 / 3)
    axes.set_ylim(-reach, reach)
    axes.set_aspect("equal")
    axes.axis("off")
    if not shown:
        draw_graph(axes, next(iter(loaded.values())), None, (0.0, 0.0), 1.0)
    for found, centre in zip(shown, GRAPH_PLACES.get(len(shown), ()), strict=True):
        draw_graph(axes, loaded[found.template], found, centre, 1.0)
