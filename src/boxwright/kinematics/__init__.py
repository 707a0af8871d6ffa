"""Forward kinematics of the articulated model, and its export for robot stacks and physics."""

from boxwright.kinematics.forward import configuration, hinge_lines, part_corners, part_motions
from boxwright.kinematics.urdf import save_urdf, urdf_text

__all__ = ["configuration", "hinge_lines", "part_corners", "part_motions", "save_urdf", "urdf_text"]
