"""Robots by name, TOML and URDF: what is read, refused and written."""

from __future__ import annotations

import io
from pathlib import Path

import msgspec
import numpy as np
import pytest
import yourdfpy

from boxwright import _core
from boxwright.robots import load_robot, robot_file, robot_names, robot_text, toml_text
from support.chain_urdf import chain_urdf

NAMES = ("franka_panda", "kuka_kr6_r700", "viper_s850")


def refusal(path: Path) -> str:
    with pytest.raises(ValueError, match=r".") as caught:
        load_robot(path)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_three_robots_are_shipped_each_with_its_sources() -> None:
    assert robot_names() == NAMES
    for name in NAMES:
        file = robot_file(name)
        assert file.name == name
        assert file.sources
        assert file.assumptions


def test_an_unknown_name_lists_those_known() -> None:
    with pytest.raises(ValueError, match=r"r2d2: no robot of that name; known are franka_panda, kuka_kr6_r700, viper"):
        load_robot("r2d2")


@pytest.mark.parametrize(("name", "reach_m"), [("viper_s850", 0.9349), ("kuka_kr6_r700", 0.7067 + 0.08)])
def test_the_reach_is_the_data_sheets(name: str, reach_m: float) -> None:
    assert load_robot(name).reach_m == pytest.approx(reach_m, abs=2e-4)


@pytest.mark.parametrize("name", NAMES)
def test_a_written_file_reads_back(name: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(toml_text(robot_file(name)), encoding="utf-8")
    assert robot_file(path) == robot_file(name)
    np.testing.assert_array_equal(load_robot(path).ready_rad, load_robot(name).ready_rad)


@pytest.mark.parametrize("name", NAMES)
def test_a_ready_arm_is_clear_of_itself_and_stands_on_its_base(name: str) -> None:
    robot = load_robot(name)
    world = _core.World(planes=[("floor", (0.0, 0.0, 1.0), 0.0)])
    clearance = _core.Clearance(robot.arm, world, 0.005, 0.08, [("base", "floor")])
    assert clearance.is_clear(robot.ready_rad[None]).all()
    low = clearance.nearest(robot.ready_rad)
    assert low is not None
    assert low[2] > 0.005
    through = _core.Clearance(robot.arm, _core.World(planes=[("ceiling", (0.0, 0.0, -1.0), -0.3)]), 0.005, 0.0)
    assert not through.is_clear(robot.ready_rad[None]).any()
    blocked = through.nearest(robot.ready_rad)
    assert blocked is not None
    assert blocked[1] == "ceiling"


def test_most_of_the_arms_range_is_clear_of_itself() -> None:
    rng = np.random.default_rng(2)
    for name in NAMES:
        robot = load_robot(name)
        clearance = _core.Clearance(robot.arm, _core.World(), 0.0, 0.08)
        positions = rng.uniform(*robot.limits_rad.T, (2000, len(robot.joint_names)))
        assert clearance.is_clear(positions).mean() > 0.6, name


def test_is_clear_is_what_nearest_says() -> None:
    robot = load_robot("viper_s850")
    rng = np.random.default_rng(3)
    place = np.eye(4)
    place[:3, 3] = [0.55, 0.1, 0.2]
    world = _core.World([("box", place, (0.4, 0.3, 0.25))], planes=[("table", (0.0, 0.0, 1.0), -0.2)])
    clearance = _core.Clearance(robot.arm, world, 0.005, 0.0, [("base", "table")])
    positions = rng.uniform(*robot.limits_rad.T, (1000, 6))
    clear = clearance.is_clear(positions)
    nearest = [clearance.nearest(row) for row in positions]
    assert all(found is not None for found in nearest)
    np.testing.assert_array_equal(clear, [found is not None and found[2] >= 0.005 for found in nearest])
    assert 200 < clear.sum() < 900
    assert {found[1] for found in nearest if found} > {"box", "table"}


def test_a_urdf_of_ones_own(tmp_path: Path) -> None:
    path = tmp_path / "mine.urdf"
    path.write_text(chain_urdf(), encoding="utf-8")
    robot = load_robot(path)
    assert not robot.closed_form
    assert robot.joint_names == [f"j{k}" for k in range(1, 7)]
    theirs = yourdfpy.URDF.load(io.StringIO(chain_urdf()), build_scene_graph=True, load_meshes=False)
    positions = np.random.default_rng(4).uniform(-2.5, 2.5, (50, 6))
    for row in positions:
        theirs.update_cfg(dict(zip(robot.joint_names, row, strict=True)))
        np.testing.assert_allclose(robot.link_frames(row)[-1], theirs.get_transform("flange"), atol=1e-12)
    assert len(robot.file.link[2].capsules) == 1
    assert any("accelerations" in line for line in robot.file.assumptions)
    again = tmp_path / "again.toml"
    again.write_text(robot_text(path), encoding="utf-8")
    assert msgspec.structs.replace(robot_file(again)) == robot.file


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        (' upper="2.5"', "", "joint j1: its limit has no upper"),
        (' velocity="3"', "", "joint j1: its limit has no velocity"),
        ('type="revolute"', 'type="continuous"', "joint j1: has no limits (continuous)"),
        ('<sphere radius="0.06"/>', '<mesh filename="a.stl"/>', "link l3: its collision shape is no primitive"),
        ('type="revolute"', 'type="fixed"', "has 5 revolute joints, 5 in a row; an arm has 6 or 7"),
        ('xyz="0 0 0.35"', 'xyz="0 0"', "joint j3: origin xyz is '0 0'; must be 3 finite numbers"),
        ("</robot>", "", "is no XML"),
    ],
)
def test_a_urdf_that_does_not_fit_is_refused(right: str, wrong: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.urdf"
    path.write_text(chain_urdf().replace(right, wrong, 1), encoding="utf-8")
    assert told in refusal(path)
    assert refusal(path).startswith(str(path))


def test_a_file_that_does_not_fit_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    text = robot_text("viper_s850")
    cases = [
        ("limits_deg = [-170.0, 170.0]\n", "", "missing required field `limits_deg` - at `$.joint[0]`"),
        ("mass_kg = 0.9", "mass_kg = -1.0", "gripper: mass_kg holds -1"),
        ("mass_kg = 0.9", "weight_kg = 0.9", "unknown field `weight_kg` - at `$.gripper`"),
        ("mass_kg = 0.9", "mass_kg =", "line"),
    ]
    for right, wrong, told in cases:
        path.write_text(text.replace(right, wrong, 1), encoding="utf-8")
        assert told in refusal(path)
    assert len(cases) == 4


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ("radius_m = 0.105", "radius_m = nan", "link[1].capsules[0].radius_m is nan; it must be a finite number"),
        ("speed_deg_per_s = 250.0", "speed_deg_per_s = nan", "joint[0].speed_deg_per_s is nan"),
        ("limits_deg = [-170.0, 170.0]", "limits_deg = [-inf, 170.0]", "joint[0].limits_deg[0] is -inf"),
    ],
)
def test_a_number_that_is_none_is_told_by_file_and_key(right: str, wrong: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(robot_text("viper_s850").replace(right, wrong, 1), encoding="utf-8")
    assert told in refusal(path)
    assert refusal(path).startswith(f"{path}: ")
    with pytest.raises(ValueError, match="finite number") as caught:
        robot_file(path)
    assert str(caught.value) == refusal(path)


def test_poses_and_positions_of_a_wrong_shape_are_refused() -> None:
    robot = load_robot("viper_s850")
    with pytest.raises(ValueError, match="there are 5 positions; viper_s850 has 6 joints"):
        robot.jacobian(np.zeros(5))
    with pytest.raises(ValueError, match="is no rotation"):
        robot.inverse(np.ones((4, 4)))
    with pytest.raises(ValueError, match=r"a pose has shape \[3, 3\]"):
        robot.inverse(np.eye(3))
