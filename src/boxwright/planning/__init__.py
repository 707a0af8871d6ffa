"""Motions that close a box: from its model, a robot and where that stands, to a plan."""

from boxwright.planning.closing import plan_closing
from boxwright.planning.measured import measured_box

__all__ = ["measured_box", "plan_closing"]
