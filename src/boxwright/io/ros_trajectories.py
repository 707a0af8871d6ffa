"""A plan's trajectory as ROS 2 has it: one `trajectory_msgs/msg/JointTrajectory` in an MCAP file (CDR, schema ros2msg).

No ROS is needed to write or read it; `ros2 bag play` publishes it.
"""

from __future__ import annotations

from os import PathLike
from typing import Any

from boxwright.types import Plan

TOPIC = "/joint_trajectory"
MESSAGE = "trajectory_msgs/msg/JointTrajectory"
FRAME = "base"
NANOSECONDS = 1_000_000_000

_RULE = "=" * 80
DEFINITION = f"""\
std_msgs/Header header
string[] joint_names
trajectory_msgs/JointTrajectoryPoint[] points
{_RULE}
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
{_RULE}
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
{_RULE}
MSG: trajectory_msgs/JointTrajectoryPoint
float64[] positions
float64[] velocities
float64[] accelerations
float64[] effort
builtin_interfaces/Duration time_from_start
{_RULE}
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
"""
"""The message's definition (ROS 2's common_interfaces), all that it names included."""


def save_ros_trajectory(plan: Plan, path: str | PathLike[str]) -> None:
    """Write the whole motion, stamped 0, with positions (rad), velocities (rad/s) and times from its start.

    Equal plans give equal bytes. Raises OSError when the file cannot be written, ValueError where nothing moves.
    """
    from mcap_ros2.writer import Writer

    points = _points(plan)
    if not points:
        raise ValueError("the plan has no motion; a trajectory has at least two points")
    message = {
        "header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": FRAME},
        "joint_names": list(plan.joint_names),
        "points": points,
    }
    with open(path, "wb") as file:
        writer = Writer(file)
        schema = writer.register_msgdef(MESSAGE, DEFINITION)
        writer.write_message(TOPIC, schema, message, log_time=0, publish_time=0)
        writer.finish()  # type: ignore[no-untyped-call]


def _points(plan: Plan) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    last_s = None
    for segment in plan.segments:
        for time_s, positions, velocities in zip(segment.times, segment.positions, segment.velocities, strict=True):
            if time_s == last_s:
                continue
            last_s = time_s
            nanoseconds = round(time_s * NANOSECONDS)
            found.append(
                {
                    "positions": list(positions),
                    "velocities": list(velocities),
                    "accelerations": [],
                    "effort": [],
                    "time_from_start": {"sec": nanoseconds // NANOSECONDS, "nanosec": nanoseconds % NANOSECONDS},
                }
            )
    return found
