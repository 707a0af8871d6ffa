"""Images (rows, columns, 3) of a view: what the camera saw, faint backgrounds, segments in colour."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from boxwright.figures.palette import of_segment
from boxwright.figures.view import View
from boxwright.perception import Perception
from boxwright.types import Cloud

Image = NDArray[np.float64]

NO_READING = 0.10
"""Grey of pixels without a reading, in the first column."""

FAINTNESS = 0.72
"""How far a background is faded to white."""


def seen_image(cloud: Cloud, view: View) -> tuple[str, Image]:
    """What the image shows ("colour", "depth") and the image: colours where the cloud has them, else distances."""
    image = np.full((*view.index.shape, 3), NO_READING)
    if cloud.colors is not None:
        shown = _coloured(cloud, view)
        image[shown >= 0] = cloud.colors[shown[shown >= 0]] / 255.0
        return "colour", image
    mine = view.index >= 0
    if mine.any():
        distances = view.distance(cloud.points[view.index[mine]].astype(np.float64))
        near, far = np.percentile(distances, (1, 99))
        shade = np.clip((far - distances) / max(far - near, 1e-9), 0.0, 1.0)
        image[mine] = colormaps["cividis"](shade)[:, :3]
    return "depth", image


def _coloured(cloud: Cloud, view: View) -> NDArray[np.int64]:
    """The point whose colour each pixel has, -1 for none; an image has colours where it has no depth too."""
    if view.is_camera_image:
        return np.arange(len(cloud.points)).reshape(view.index.shape)
    return view.index


def faint(image: Image, cloud: Cloud, view: View) -> Image:
    """The image in grey, faded to white, to draw on; white where nothing was seen."""
    grey = image @ np.array([0.299, 0.587, 0.114])
    faded = FAINTNESS + (1.0 - FAINTNESS) * grey
    if cloud.colors is None or not view.is_camera_image:
        faded[view.index < 0] = 1.0
    return np.repeat(faded[:, :, None], 3, axis=2)


def segment_image(view: View, perception: Perception, background: Image, tint: float = 1.0) -> Image:
    """Each segment's readings in its own colour on the background, which shines through where `tint` is below 1."""
    colours = np.array([to_rgb(of_segment(s)) for s in range(len(perception))]).reshape(-1, 3)
    labels = np.where(view.index >= 0, perception.labels[view.index], -1)
    image = background.copy()
    mine = labels >= 0
    image[mine] = (1.0 - tint) * image[mine] + tint * colours[labels[mine]]
    return image
