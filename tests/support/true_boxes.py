"""The truth of an open box that stands at the origin of its input's frame, z up; no frame is made."""

from __future__ import annotations

import numpy as np

from boxwright.simulation.boxes import Flap, OpenBox
from boxwright.simulation.poses import apply, standing
from boxwright.simulation.scene import place
from boxwright.types import TrueBox, TruePart, Truth


def truth_of(box: OpenBox, *, x_m: float = 0.0, y_m: float = 0.0, yaw_rad: float = 0.0, z_m: float = 0.0) -> Truth:
    """A box as the simulated frames tell their truth, seen by nobody."""
    placed = place(box, standing(x_m, y_m, yaw_rad, z_m))
    parts = []
    for panel in placed.panels:
        corners = tuple(map(tuple, apply(placed.world_from_box, panel.corners).tolist()))
        angle_deg = None if panel.angle_rad is None else float(np.degrees(panel.angle_rad))
        parts.append(TruePart(0, panel.name, panel.parent, panel.extra, angle_deg, corners, 0))  # type: ignore[arg-type]
    dims = (box.length_m, box.width_m, box.height_m)
    found = TrueBox(0, box.category, box.variant, dims)
    return Truth("made", box.category, None, (0.0, 0.0, 1.0), (found,), tuple(parts))


def carton(*angles_deg: float) -> OpenBox:
    """A carton whose flaps meet in the middle, standing up unless told otherwise."""
    degrees = angles_deg or (95.0, 95.0, 95.0, 95.0)
    first, second, third, fourth = (Flap(0.106, float(np.radians(angle)), 0.0045) for angle in degrees)
    return OpenBox("small", "rsc", 0.30, 0.22, 0.16, 0.004, (first, second, third, fourth))
