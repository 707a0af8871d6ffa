"""Robots as data, and their kinematics (docs/robots.md)."""

from boxwright.robots.catalogue import robot_file, robot_names, robot_text
from boxwright.robots.robot import Robot, Solutions, load_robot
from boxwright.robots.robot_toml import toml_text
from boxwright.robots.urdf_write import save_robot_urdf, urdf_of_robot

__all__ = [
    "Robot",
    "Solutions",
    "load_robot",
    "robot_file",
    "robot_names",
    "robot_text",
    "save_robot_urdf",
    "toml_text",
    "urdf_of_robot",
]
