"""Segments seen from above, in metres: what stands where, what belongs together."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from numpy.typing import NDArray

from boxwright.figures.overlays import write_number
from boxwright.figures.palette import FAINT, INK, of_group
from boxwright.types import Segmentation

Array = NDArray[np.float64]

ROOM = 0.08
"""Left free around what is shown, as a share of its size."""


def draw_from_above(axes: Axes, segmentation: Segmentation, eye: Array) -> None:
    """The rectangles projected along `up`, in their groups' colours, high ones last, the camera below."""
    axes.set_title("from above, metres; colours by group", fontsize=10, color=INK, loc="left", pad=5)
    axes.set_aspect("equal", adjustable="box")
    axes.tick_params(labelsize=8, colors=INK)
    axes.grid(color=FAINT, linewidth=0.4)
    for spine in axes.spines.values():
        spine.set_color(FAINT)
    things = [k for k, segment in enumerate(segmentation.segments) if segment.group >= 0]
    shown = things or list(range(len(segmentation.segments)))
    if not shown:
        return
    up = np.array(segmentation.up)
    corners = {k: np.array(segmentation.segments[k].rectangle) for k in shown}
    centre = np.median(np.concatenate(list(corners.values())), axis=0)
    axes_level = _level_axes(up, centre - eye)
    flat = {k: (rectangle - centre) @ axes_level.T for k, rectangle in corners.items()}
    for k in sorted(shown, key=lambda k: (float(corners[k].mean(axis=0) @ up), k)):
        colour = of_group(segmentation.segments[k].group)
        axes.add_patch(Polygon(flat[k], closed=True, facecolor=colour, alpha=0.35, linewidth=0))
        axes.add_patch(Polygon(flat[k], closed=True, fill=False, edgecolor=colour, linewidth=1.4))
    for k in shown:
        write_number(axes, flat[k].mean(axis=0), k, of_group(segmentation.segments[k].group))
    everything = np.concatenate(list(flat.values()))
    low, high = everything.min(axis=0), everything.max(axis=0)
    room = ROOM * float((high - low).max()) + 1e-3
    axes.set_xlim(low[0] - room, high[0] + room)
    axes.set_ylim(low[1] - room, high[1] + room)


def _level_axes(up: Array, away: Array) -> Array:
    """Two unit vectors (2, 3) square to `up`: to the right and away from the camera."""
    level = away - (away @ up) * up
    if np.linalg.norm(level) < 1e-6:
        level = np.linalg.svd(up[None, :])[2][1]
    level = level / np.linalg.norm(level)
    return np.array([np.cross(level, up), level])
