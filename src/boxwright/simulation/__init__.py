"""Simulated frames of open boxes with exact truth. Imports nothing of perception, inference or models."""

from boxwright.simulation.conditions import Conditions
from boxwright.simulation.drawing import CATEGORIES, NONE
from boxwright.simulation.frames import Frame, make_frame
from boxwright.simulation.looks import Look, make_looks
from boxwright.simulation.sets import write_frame, write_frames, write_set

__all__ = [
    "CATEGORIES",
    "NONE",
    "Conditions",
    "Frame",
    "Look",
    "make_frame",
    "make_looks",
    "write_frame",
    "write_frames",
    "write_set",
]
