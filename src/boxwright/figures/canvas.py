"""What all pictures share: axes that show an image, and the file."""

from __future__ import annotations

from os import PathLike
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from boxwright.figures.images import Image
from boxwright.figures.palette import FAINT, INK
from boxwright.figures.window import Window

DOTS_PER_INCH = 110


def save_png(figure: Figure, path: str | PathLike[str]) -> None:
    """Draws a figure into a file; equal figures give equal bytes. Raises OSError where it cannot be written."""
    FigureCanvasAgg(figure)
    with Path(path).open("wb") as stream:
        figure.savefig(stream, format="png", dpi=DOTS_PER_INCH, metadata={"Software": None})


def show(axes: Axes, image: Image, title: str, window: Window | None = None) -> None:
    """An image with its title, enlarged to a window where one is given."""
    axes.imshow(image, interpolation="nearest" if window is None else "antialiased")
    axes.set_title(title, fontsize=10, color=INK, loc="left", pad=5)
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_color(FAINT)
    if window is not None:
        axes.set_xlim(window.left, window.right)
        axes.set_ylim(window.bottom, window.top)
