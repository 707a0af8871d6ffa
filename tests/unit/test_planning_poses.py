"""What is said of a camera pose before and beside a plan: how level, how low, how far."""

from __future__ import annotations

import json
import warnings
from pathlib import Path

import numpy as np
import pytest
from closing.problems import draw_problem
from numpy.typing import NDArray

from boxwright.io.plans import load_pose
from boxwright.io.truth import load_truth
from boxwright.kinematics.transforms import rigid, turn_about_line
from boxwright.planning import plan_closing
from boxwright.planning.checks import warnings_of
from boxwright.planning.reach import reach_of, refuse_out_of_reach
from boxwright.robots import load_robot, robot_names

ROBOT = "viper_s850"


def tilted(angle_deg: float) -> NDArray[np.float64]:
    return turn_about_line((0.0, 0.0, 0.0), (0.0, 1.0, 0.0), np.radians(angle_deg))


def moved(x_m: float = 0.0, z_m: float = 0.0) -> NDArray[np.float64]:
    return rigid(np.eye(3), [x_m, 0.0, z_m])


@pytest.mark.parametrize("angle_deg", [0.0, 1.0, -1.4])
def test_a_support_that_is_as_level_as_cameras_are_calibrated_is_not_told_of(angle_deg: float) -> None:
    model = draw_problem(1).model
    assert warnings_of(model, model.objects[0], tilted(angle_deg)) == []


@pytest.mark.parametrize("angle_deg", [1.7, 3.0, -5.0])
def test_a_pose_that_tilts_the_support_is_told_with_angle_and_height(angle_deg: float) -> None:
    model = draw_problem(1).model
    (line,) = warnings_of(model, model.objects[0], tilted(angle_deg))
    corners = np.concatenate([np.array(part.corners) for part in model.objects[0].parts if part.corners is not None])
    away_m = float(np.hypot(*corners.mean(axis=0)[:2]))
    off_mm = 1000.0 * away_m * np.tan(np.radians(abs(angle_deg)))
    assert f"the support leans {abs(angle_deg):.1f} degrees against the robot's z" in line
    assert float(line.split("by up to ")[1].split(" mm")[0]) == pytest.approx(off_mm, rel=0.1)
    assert "check the camera pose" in line


def test_a_box_that_stands_below_the_floor_is_told_of() -> None:
    model = draw_problem(1).model
    (line,) = warnings_of(model, model.objects[0], moved(z_m=-1.0))
    assert "m below the robot's base, below the floor unless" in line
    assert warnings_of(model, model.objects[0], moved(z_m=-0.3)) == []


@pytest.mark.parametrize("name", robot_names())
def test_no_posture_takes_the_tool_out_of_the_reach_and_some_nearly_do(name: str) -> None:
    robot = load_robot(name)
    reach = reach_of(robot)
    positions = np.random.default_rng(5).uniform(*robot.limits_rad.T, (50_000, len(robot.joint_names)))
    away_m = np.linalg.norm(robot.forward(positions)[:, :3, 3] - reach.shoulder_m, axis=1)
    assert 0.85 * reach.radius_m < away_m.max() < reach.radius_m


def test_a_box_out_of_the_arms_reach_is_refused_with_distance_and_reach() -> None:
    model = draw_problem(1).model
    with pytest.raises(ValueError, match=r"the box is 2\.\d\d m from the arm's shoulder, out of reach") as caught:
        plan_closing(model, ROBOT, moved(x_m=2.0))
    assert f"viper_s850 with its tool reaches {reach_of(load_robot(ROBOT)).radius_m:.2f} m" in str(caught.value)
    with pytest.raises(ValueError, match=r"from the arm's shoulder and 1\.\d\d m below its base, out of reach"):
        plan_closing(model, ROBOT, moved(z_m=-2.0))


def test_a_box_partly_in_reach_is_not_refused() -> None:
    robot, model = load_robot(ROBOT), draw_problem(1).model

    refuse_out_of_reach(robot, model.objects[0], moved(x_m=0.3))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("value", [1e308, 370.6, -25.0])
def test_a_position_that_no_robot_stands_at_is_refused_with_file_and_key(value: float, tmp_path: Path) -> None:
    path = tmp_path / "pose.json"
    path.write_text(json.dumps({"position": [value, 0.0, 0.0], "orientation": [0.0, 0.0, 0.0, 1.0]}), encoding="utf-8")
    with pytest.raises(ValueError, match=r"pose\.json: position: holds .*; it is in metres, not millimetres"):
        load_pose(path)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError, match=r"camera pose: position is \(.*; base_from_input is in metres"):
            plan_closing(draw_problem(1).model, ROBOT, moved(x_m=value))


def test_no_support_of_a_labelled_frame_is_told_to_lean_where_the_pose_is_true(shared_dir: Path) -> None:
    import boxwright

    asked = 0
    for path in sorted((shared_dir / "data" / "labelled").glob("*.pcd"))[::3]:
        truth = load_truth(path.with_suffix(".truth.json"))
        model = boxwright.infer(boxwright.read_cloud(path)).model
        for found in model.objects:
            assert not any("leans" in line for line in warnings_of(model, found, _level(truth.up))), path.name
            asked += 1
    assert asked >= 5


def _level(up: tuple[float, float, float]) -> NDArray[np.float64]:
    """The input's frame turned so that its true up is z, a metre above the base."""
    z = np.array(up) / np.linalg.norm(up)
    aside = np.eye(3)[int(np.argmin(np.abs(z)))]
    x = np.cross(aside, z) / np.linalg.norm(np.cross(aside, z))
    return rigid(np.stack([x, np.cross(z, x), z]), [0.0, 0.0, 1.0])
