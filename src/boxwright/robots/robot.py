"""An arm that can be asked where its tool is, and how to put it somewhere. Metres, radians, the base's frame."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike

import numpy as np
from numpy.typing import ArrayLike, NDArray

from boxwright import _core
from boxwright.kinematics.transforms import inverse, rigid
from boxwright.robots.catalogue import robot_file
from boxwright.robots.robot_toml import toml_text
from boxwright.types import RobotFile

Array = NDArray[np.float64]

REACH_STEPS = 1441
"""Positions that are tried of a joint: a quarter of a degree apart on a joint of 360 degrees."""
REACH_TOLERANCE_M = 1e-6


@dataclass(frozen=True)
class Solutions:
    """Joint positions that reach one pose: `positions` (K, axes) rad; `branch` (K,), 0..7 of the closed form.

    `singular` (K, 3): whether the wrist's centre is near joint 1's axis, the elbow is straight, the wrist is straight;
    of a numeric inverse, whether the arm is near any singularity, three times the same.
    """

    positions: Array
    branch: NDArray[np.uint8]
    singular: NDArray[np.bool_]


@dataclass(frozen=True)
class Robot:
    """A robot: what its file says, and the core's arm made of it."""

    file: RobotFile
    arm: _core.Arm

    @property
    def name(self) -> str:
        """As the file has it."""
        return self.file.name

    @property
    def joint_names(self) -> list[str]:
        """First joint first."""
        return self.arm.joint_names

    @property
    def limits_rad(self) -> Array:
        """(axes, 2)."""
        return self.arm.limits

    @property
    def ready_rad(self) -> Array:
        """(axes,): where the arm waits."""
        return self.arm.ready

    @property
    def closed_form(self) -> bool:
        """Whether the inverse is complete; else it is what a numeric search finds."""
        return self.arm.closed_form

    @property
    def reach_m(self) -> float:
        """How far the flange comes from joint 1's axis within limits: one joint after another turned for the best."""
        flange_from_tool = rigid(np.eye(3), self.file.gripper.tool_point_m)
        best, reach_m = self.ready_rad.copy(), 0.0
        while True:
            before_m = reach_m
            for k, (lower, upper) in enumerate(self.limits_rad):
                tried = np.tile(best, (REACH_STEPS, 1))
                tried[:, k] = np.linspace(lower, upper, REACH_STEPS)
                flanges = self.forward(tried) @ inverse(flange_from_tool)
                away_m = np.hypot(flanges[:, 0, 3], flanges[:, 1, 3])
                best, reach_m = tried[int(np.argmax(away_m))], float(away_m.max())
            if reach_m - before_m < REACH_TOLERANCE_M:
                return reach_m

    def forward(self, positions_rad: ArrayLike) -> Array:
        """base_from_tool at positions (axes,) or (N, axes): (4, 4) or (N, 4, 4)."""
        positions = np.asarray(positions_rad, np.float64)
        poses = self.arm.forward(np.atleast_2d(positions))
        return poses[0] if positions.ndim == 1 else poses

    def link_frames(self, positions_rad: ArrayLike) -> Array:
        """(axes + 2, 4, 4): the base, each link and the flange at positions (axes,)."""
        return self.arm.link_frames(np.asarray(positions_rad, np.float64))

    def jacobian(self, positions_rad: ArrayLike) -> Array:
        """(6, axes): the tool's velocity (m/s, then rad/s) for each rad/s of a joint, in the base's frame."""
        return self.arm.jacobian(np.asarray(positions_rad, np.float64))

    def inverse(self, base_from_tool: ArrayLike, near_rad: ArrayLike | None = None) -> Solutions:
        """All joint positions within limits that put the tool at a pose (4, 4); none where it cannot be reached.

        A closed form gives every branch and every wrap; a numeric search starts from `near_rad` (axes,) or the ready
        pose, then from fixed places, and gives what it finds. Raises ValueError where the pose is none.
        """
        near = None if near_rad is None else np.asarray(near_rad, np.float64)
        return Solutions(*self.arm.inverse(np.asarray(base_from_tool, np.float64), near))


def load_robot(robot: str | PathLike[str]) -> Robot:
    """A shipped robot by its name, or one's own by its .toml or .urdf file (docs/robots.md).

    Raises OSError when the file cannot be read, ValueError naming the key that does not fit, or the robots known.
    """
    file = robot_file(robot)
    try:
        return Robot(file, _core.Arm(toml_text(file)))
    except ValueError as error:
        raise ValueError(f"{robot}: {error}") from None
