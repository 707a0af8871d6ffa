"""Pictures, drawn by matplotlib without a screen (the extra `figures`)."""

from boxwright.figures.frame import save_frame_figure
from boxwright.figures.segments import save_segments_figure

__all__ = ["save_frame_figure", "save_segments_figure"]
