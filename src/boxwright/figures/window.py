"""Which part of an image to enlarge."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.figures.view import View
from boxwright.pipeline import Inferred

MARGIN = 0.12
"""Room around the subject, as a share of its size."""

LEAST_SHARE = 0.3
"""The window is at least so much of the image's width."""


@dataclass(frozen=True)
class Window:
    """Columns left..right and rows top..bottom of an image, pixels; it may reach beyond the image."""

    left: float
    right: float
    top: float
    bottom: float


def window_of(view: View, inferred: Inferred) -> Window:
    """Around the objects; where there is none around the segments; where there is none, all. In the image's shape."""
    objects = inferred.model.objects
    labels = inferred.object_labels if objects else inferred.perception.labels
    panels = [np.array(part.corners) for found in objects for part in found.parts if part.corners is not None]
    return window_around(view, labels >= 0, panels)


def window_around(view: View, subject: NDArray[np.bool_], outlines: Sequence[NDArray[np.float64]]) -> Window:
    """Around the points (N,) that are the subject and outlines (K, 3) metres; all where there are none."""
    rows, columns = view.index.shape
    pixels = _subject(view, subject, outlines)
    if len(pixels) == 0:
        return Window(-0.5, columns - 0.5, -0.5, rows - 0.5)
    low, high = pixels.min(axis=0), pixels.max(axis=0)
    centre = (low + high) / 2.0
    extent = np.maximum((high - low) * (1.0 + 2.0 * MARGIN), LEAST_SHARE * columns * np.array([1.0, rows / columns]))
    scale = min(max(extent[0] / columns, extent[1] / rows), 1.0)
    half = np.array([columns, rows]) * scale / 2.0
    centre = np.clip(centre, half - 0.5, np.array([columns, rows]) - 0.5 - half)
    return Window(centre[0] - half[0], centre[0] + half[0], centre[1] - half[1], centre[1] + half[1])


def _subject(view: View, subject: NDArray[np.bool_], outlines: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Pixels (N, 2) of what the picture is about."""
    rows, columns = np.nonzero((view.index >= 0) & subject[view.index])
    pixels = [np.column_stack([columns, rows]).astype(np.float64)]
    pixels += [view.project(corners) for corners in outlines if view.has_before_it(corners)]
    return np.concatenate(pixels)
