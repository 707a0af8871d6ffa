"""Figures, where the extra that draws them is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from boxwright.pipeline import Inferred
    from boxwright.types import Cloud

    Drawer = Callable[[Cloud, Inferred, Path, tuple[str | Path, ...]], None]


def frame_figure_drawer() -> Drawer:
    """What draws a frame's figure. Raises ValueError where matplotlib is missing, before any work is done."""
    try:
        from boxwright.figures import save_frame_figure
    except ModuleNotFoundError as error:
        raise ValueError(f"figures need {error.name}, which is missing; pip install 'boxwright[figures]'") from None
    return save_frame_figure
