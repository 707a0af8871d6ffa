"""Pictures, drawn by matplotlib without a screen (the extra `figures`)."""

from boxwright.figures.frame import save_frame_figure

__all__ = ["save_frame_figure"]
