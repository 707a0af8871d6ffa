"""Boxes under a robot arm in MuJoCo: do the flaps close, and do they stay closed? Imports nothing that plans."""

from boxwright.simulation.physics.arm import Arm
from boxwright.simulation.physics.boards import BoardBox, modelled_box, true_box
from boxwright.simulation.physics.creases import Crease, crease_class, load_creases
from boxwright.simulation.physics.live import LiveBox, cloud_of
from boxwright.simulation.physics.plans import Staged, require_motion, simulate, staged_plan
from boxwright.simulation.physics.robot_file import load_robot
from boxwright.simulation.physics.run import CREASE, Run, run_of, simulate_closing
from boxwright.simulation.physics.session import Load, Session
from boxwright.simulation.physics.settings import PhysicsSettings

__all__ = [
    "CREASE",
    "Arm",
    "BoardBox",
    "Crease",
    "LiveBox",
    "Load",
    "PhysicsSettings",
    "Run",
    "Session",
    "Staged",
    "cloud_of",
    "crease_class",
    "load_creases",
    "load_robot",
    "modelled_box",
    "require_motion",
    "run_of",
    "simulate",
    "simulate_closing",
    "staged_plan",
    "true_box",
]
