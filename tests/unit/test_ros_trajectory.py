"""trajectory.mcap reads back as the plan's motion."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from mcap_ros2.reader import read_ros2_messages

from boxwright.io.plans import samples
from boxwright.io.ros_trajectories import DEFINITION, MESSAGE, TOPIC, save_ros_trajectory
from boxwright.types import Plan
from support.sample_plan import sample_plan


def test_the_trajectory_reads_back(tmp_path: Path) -> None:
    plan = msgspec.convert(sample_plan(), Plan)
    path = tmp_path / "trajectory.mcap"
    save_ros_trajectory(plan, path)
    (message,) = read_ros2_messages(str(path))
    assert (message.channel.topic, message.schema.name, message.schema.encoding) == (TOPIC, MESSAGE, "ros2msg")
    assert message.channel.message_encoding == "cdr"
    trajectory = message.ros_msg
    assert tuple(trajectory.joint_names) == plan.joint_names
    expected = list(samples(plan))
    assert len(trajectory.points) == len(expected) == 9
    for point, (time_s, positions) in zip(trajectory.points, expected, strict=True):
        assert tuple(point.positions) == positions
        assert point.time_from_start.sec + 1e-9 * point.time_from_start.nanosec == pytest.approx(time_s, abs=1e-9)
        assert len(point.velocities) == len(positions)


def test_equal_plans_give_equal_bytes(tmp_path: Path) -> None:
    plan = msgspec.convert(sample_plan(), Plan)
    for name in ("a.mcap", "b.mcap"):
        save_ros_trajectory(plan, tmp_path / name)
    assert (tmp_path / "a.mcap").read_bytes() == (tmp_path / "b.mcap").read_bytes()


def test_a_plan_without_motion_is_refused(tmp_path: Path) -> None:
    data = sample_plan() | {"segments": []}
    with pytest.raises(ValueError, match="no motion"):
        save_ros_trajectory(msgspec.convert(data, Plan), tmp_path / "trajectory.mcap")


def test_the_definition_tells_each_type_that_it_names() -> None:
    for name in ("Header", "Time", "JointTrajectoryPoint", "Duration"):
        assert f"/{name}\n" in DEFINITION
