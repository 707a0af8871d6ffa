"""How often a numeric inverse finds a pose made inside the limits, and how long it takes.

`python benchmarks/inverse_share.py`

Each arm by the numeric search, those with a closed form too, told as a chain of joints; and the closed form beside it.
"""

from __future__ import annotations

import time

import msgspec
import numpy as np

from boxwright import _core
from boxwright.kinematics.transforms import roll_pitch_yaw
from boxwright.robots import Robot, load_robot, robot_names, toml_text
from boxwright.types import Place

POSES = 1000


def as_chain(robot: Robot) -> _core.Arm:
    """The same arm, each joint told by its place: the core then has no closed form."""
    joints = []
    for joint, place, axis in zip(robot.file.joint, robot.arm.parent_from_joint, robot.arm.axes, strict=True):
        rpy_deg = tuple(np.degrees(roll_pitch_yaw(place[:3, :3])).tolist())
        joints.append(
            msgspec.structs.replace(
                joint, xyz_m=tuple(place[:3, 3].tolist()), rpy_deg=rpy_deg, axis=tuple(axis.tolist())
            )
        )
    last = robot.arm.last_link_from_flange
    rpy_deg = tuple(np.degrees(roll_pitch_yaw(last[:3, :3])).tolist())
    flange = Place(xyz_m=tuple(last[:3, 3].tolist()), rpy_deg=rpy_deg)
    return _core.Arm(toml_text(msgspec.structs.replace(robot.file, opw=None, joint=tuple(joints), flange=flange)))


def measure(arm: _core.Arm) -> tuple[float, float, float]:
    """Share of poses reached in per cent, solutions of those, and milliseconds a pose."""
    positions = np.random.default_rng(1).uniform(*arm.limits.T, (POSES, len(arm.joint_names)))
    tools = arm.forward(positions)
    started = time.perf_counter()
    counts = np.array([len(arm.inverse(tool)[0]) for tool in tools])
    milliseconds = (time.perf_counter() - started) / POSES * 1e3
    return float(100.0 * np.mean(counts > 0)), float(counts[counts > 0].mean()), milliseconds


def main() -> None:
    print(f"{POSES} poses of the tool, made at random positions within the limits")
    print(f"{'arm':16}{'inverse':14}{'reached %':>10}{'solutions':>11}{'ms a pose':>11}")
    for name in robot_names():
        robot = load_robot(name)
        arms = {"closed form": robot.arm, "numeric": as_chain(robot)} if robot.closed_form else {"numeric": robot.arm}
        for kind, arm in arms.items():
            share, solutions, milliseconds = measure(arm)
            print(f"{name:16}{kind:14}{share:10.1f}{solutions:11.1f}{milliseconds:11.3f}")


if __name__ == "__main__":
    main()
