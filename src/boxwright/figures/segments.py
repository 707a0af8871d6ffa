"""A cloud's segments: where they lie in the image, what ends their sides, and how they stand, from above."""

from __future__ import annotations

from os import PathLike

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from boxwright.figures.canvas import save_png, show
from boxwright.figures.from_above import draw_from_above
from boxwright.figures.images import faint, seen_image, segment_image
from boxwright.figures.overlays import draw_numbers, draw_sides
from boxwright.figures.palette import INK, SIDES
from boxwright.figures.view import view_of
from boxwright.figures.window import window_around
from boxwright.segmentation import Segmented
from boxwright.types import Cloud

INCHES = (13.0, 6.0)
IMAGE_SHARE = (1.5, 1.0)

MEANINGS = {
    "edge": "its own end",
    "crease": "another goes on",
    "occluded": "hidden from there",
    "border": "the frame ends",
}


def save_segments_figure(cloud: Cloud, segmented: Segmented, path: str | PathLike[str]) -> None:
    """Draws a cloud's segments as PNG; equal arguments give equal bytes. Raises OSError where it cannot be written."""
    save_png(segments_figure(cloud, segmented), path)


def segments_figure(cloud: Cloud, segmented: Segmented) -> Figure:
    """The figure itself, to be drawn on any canvas."""
    perception, segments = segmented.perception, segmented.segmentation.segments
    figure = Figure(figsize=INCHES, facecolor="white")
    image, above = figure.subplots(1, 2, width_ratios=IMAGE_SHARE)
    figure.subplots_adjust(left=0.008, right=0.985, top=0.93, bottom=0.10, wspace=0.10)

    view = view_of(cloud, perception)
    grouped = np.array([segment.group >= 0 for segment in segments] + [False])
    things = grouped[perception.labels]
    window = window_around(view, things if things.any() else perception.labels >= 0, ())
    kind, seen = seen_image(cloud, view)
    tinted = segment_image(view, perception, faint(seen, cloud, view), tint=0.55)
    groups = len({segment.group for segment in segments if segment.group >= 0})
    count = f"{len(segments)} segments in {groups} group{'' if groups == 1 else 's'}"
    show(image, tinted, f"{segmented.segmentation.source.file}: {count} over the {kind}", window)
    draw_sides(image, view, segments)
    draw_numbers(image, view, segments)
    draw_from_above(above, segmented.segmentation, view.eye)
    _legend(figure)
    return figure


def _legend(figure: Figure) -> None:
    lines = [
        Line2D([], [], color=colour, linestyle=dashes, linewidth=2.2, label=f"{kind}: {MEANINGS[kind]}")
        for kind, (colour, dashes) in SIDES.items()
    ]
    figure.legend(handles=lines, loc="lower left", ncols=4, frameon=False, fontsize=10, labelcolor=INK,
                  bbox_to_anchor=(0.0, 0.0), handlelength=3.5)  # fmt: skip
