"""Forward kinematics of the articulated model, and its export for robot stacks and physics."""

from boxwright.kinematics.forward import configuration, hinge_lines, part_corners, part_motions
from boxwright.kinematics.mjcf import mjcf_text, save_mjcf
from boxwright.kinematics.sdf import save_sdf, sdf_text
from boxwright.kinematics.urdf import save_urdf, urdf_text

__all__ = [
    "configuration",
    "hinge_lines",
    "mjcf_text",
    "part_corners",
    "part_motions",
    "save_mjcf",
    "save_sdf",
    "save_urdf",
    "sdf_text",
    "urdf_text",
]
