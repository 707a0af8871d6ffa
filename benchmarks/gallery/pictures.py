"""Pictures of frames: what was told in colour, true panels that no right part holds outlined in red."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.gallery.how_seen import SIGHTS, SeenFlap
from benchmarks.gallery.tables import full_share
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from boxwright.evaluation import list_set, read_entry
from boxwright.figures.canvas import save_png, show
from boxwright.figures.images import faint, seen_image
from boxwright.figures.overlays import draw_objects
from boxwright.figures.view import view_of
from boxwright.io.clouds import read_cloud
from boxwright.pipeline import infer

WORST, COLUMNS = 10, 4
OF_A_SIGHT = 4
"""Frames of each way of being seen, at most."""
MISSED = "#d62728"
Picture = tuple[str, str]
"""A frame's name, and what is written over it."""


def chosen(evaluation: dict[str, Any]) -> list[Picture]:
    """The best frame, the middle one and the worst, by mean full accuracy; ties by name."""
    frames = [frame for frame in evaluation["frames"] if frame["boxes"]]
    ranked = sorted((float(np.mean([*map(full_share, frame["boxes"])])), str(frame["name"])) for frame in frames)
    picked = [ranked[-1], ranked[len(ranked) // 2], *ranked[:WORST]]
    return [(name, f"{name}: full {100 * share:.0f} %") for share, name in picked]


def with_lost_flaps(flaps: Sequence[SeenFlap]) -> list[Picture]:
    """Frames that lose flaps, by how the flap is seen; a frame once for each way."""
    found: list[Picture] = []
    for sight in SIGHTS:
        names = dict.fromkeys(flap.frame for flap in flaps if flap.is_lost and flap.sight == sight)
        found.extend((name, f"{name}: {sight}") for name in list(names)[:OF_A_SIGHT])
    return found


def with_false_objects(evaluation: dict[str, Any]) -> list[Picture]:
    """Frames in which something is told that is no box."""
    false = [frame for frame in evaluation["frames"] if frame["false_objects"]]
    return [(frame["name"], f"{frame['name']}: {frame['false_objects']} told that is none") for frame in false]


def draw(axes: Axes, folder: Path, evaluation: dict[str, Any], name: str, title: str) -> None:
    """One frame: its image, what is told of it, and what was missed."""
    entry = next(entry for entry in list_set(folder) if entry.name == name)
    frame, cloud = read_entry(entry), read_cloud(entry.cloud_path)
    inferred = infer(cloud, method=evaluation["method"])
    view = view_of(cloud, inferred.perception)
    _, seen = seen_image(cloud, view)
    show(axes, faint(seen, cloud, view), title)
    draw_objects(axes, view, inferred.model.objects)
    told = next(told for told in evaluation["frames"] if told["name"] == name)
    missed = {(box["box"], panel.replace("_", "")) for box in told["boxes"] for panel in box["missed"]}
    for part in frame.truth.parts:
        corners = np.array(part.corners)
        if (part.box, part.name) in missed and view.has_before_it(corners):
            axes.add_patch(Polygon(view.project(corners), closed=True, fill=False, edgecolor=MISSED, linewidth=1.4))


def save(pictures: Sequence[Picture], folder: Path, evaluation: dict[str, Any], path: Path) -> None:
    """Pictures of a set's frames as one PNG, row by row."""
    rows = max(1, -(-len(pictures) // COLUMNS))
    figure = Figure(figsize=(4.2 * COLUMNS, 3.4 * rows), facecolor="white")
    grid = figure.subplots(rows, COLUMNS, squeeze=False).ravel()
    figure.subplots_adjust(left=0.005, right=0.995, top=1.0 - 0.13 / rows, bottom=0.01, wspace=0.03, hspace=0.14)
    for axes in grid[len(pictures) :]:
        axes.set_axis_off()
    for axes, (name, title) in zip(grid, pictures, strict=False):
        draw(axes, folder, evaluation, name, title)
    save_png(figure, path)
