"""Motions that close a box: from its model, a robot and where that stands, to a plan."""

from boxwright.planning.asking import ask_bearable, ask_feasible
from boxwright.planning.assumed import assumed
from boxwright.planning.closing import plan_closing
from boxwright.planning.measured import measured_box
from boxwright.planning.placement import place_robot, with_moves
from boxwright.planning.scene import read_scene

__all__ = [
    "ask_bearable",
    "ask_feasible",
    "assumed",
    "measured_box",
    "place_robot",
    "plan_closing",
    "read_scene",
    "with_moves",
]
