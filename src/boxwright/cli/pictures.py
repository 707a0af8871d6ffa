"""Figures, where the extra that draws them is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from boxwright.pipeline import Inferred
    from boxwright.segmentation import Segmented
    from boxwright.types import Cloud

    Drawer = Callable[[Cloud, Inferred, Path, tuple[str | Path, ...]], None]


def frame_figure_drawer() -> Drawer:
    """What draws a frame's figure. Raises ValueError where matplotlib is missing, before any work is done."""
    try:
        from boxwright.figures import save_frame_figure
    except ModuleNotFoundError as error:
        raise _missing(error) from None
    return save_frame_figure


def segments_figure_drawer() -> Callable[[Cloud, Segmented, Path], None]:
    """What draws a cloud's segments. Raises ValueError where matplotlib is missing, before any work is done."""
    try:
        from boxwright.figures import save_segments_figure
    except ModuleNotFoundError as error:
        raise _missing(error) from None
    return save_segments_figure


def _missing(error: ModuleNotFoundError) -> ValueError:
    return ValueError(f"figures need {error.name}, which is missing; pip install 'boxwright[figures]'")
