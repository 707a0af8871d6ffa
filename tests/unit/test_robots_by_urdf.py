"""Arms by URDF: what is read back of our own, and what is guessed where URDF tells nothing."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import msgspec
import numpy as np
import pytest
from closing.problems import draw_problem

from boxwright import _core
from boxwright.planning import plan_closing
from boxwright.robots import load_robot, robot_file, robot_names, robot_text, toml_text, urdf_of_robot
from support.chain_urdf import chain_urdf

OURS = "<boxwright>"


def bare_urdf(name: str) -> str:
    """A shipped arm's URDF as another program would have written it."""
    root = ET.fromstring(urdf_of_robot(load_robot(name)))
    ours = root.find("boxwright")
    assert ours is not None
    root.remove(ours)
    return ET.tostring(root, encoding="unicode")


def saved(text: str, folder: Path, name: str = "mine") -> Path:
    path = folder / f"{name}.urdf"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("name", robot_names())
def test_a_shipped_arm_comes_back_from_its_own_urdf_as_it_was(name: str, tmp_path: Path) -> None:
    path = saved(urdf_of_robot(load_robot(name)), tmp_path, name)
    told = robot_file(name)
    assert robot_file(path) == msgspec.structs.replace(told, description=f"from the URDF of {name}")


def test_an_arm_plans_by_its_own_urdf_what_it_plans_by_its_toml(tmp_path: Path) -> None:
    path = saved(urdf_of_robot(load_robot("viper_s850")), tmp_path, "viper_s850")
    model = draw_problem(11).model
    by_toml, by_urdf = (plan_closing(model, robot, np.eye(4)) for robot in ("viper_s850", path))
    assert by_toml.order == ("flap_1",)
    assert by_urdf.segments == by_toml.segments


@pytest.mark.parametrize("name", robot_names())
def test_links_that_are_drawn_too_thick_are_found_and_the_arm_waits_clear_of_itself(name: str, tmp_path: Path) -> None:
    robot = load_robot(saved(bare_urdf(name), tmp_path))
    told = robot_file(name).may_touch
    assert robot.file.may_touch
    assert set(robot.file.may_touch) <= set(told)
    for opening_m in robot.file.gripper.opening_m:
        clearance = _core.Clearance(robot.arm, _core.World(), 0.005, opening_m)
        assert clearance.is_clear(robot.ready_rad[None]).all()
    shoulder_m = robot.link_frames(robot.ready_rad)[2, 2, 3]
    assert robot.forward(robot.ready_rad)[2, 3] > shoulder_m
    said = " ".join(robot.file.assumptions)
    assert " and ".join(robot.file.may_touch[0]) in said
    assert "ready_deg" in said


def test_what_is_guessed_is_the_same_each_time(tmp_path: Path) -> None:
    text = bare_urdf("franka_panda")
    paths = [saved(text, tmp_path / part, "arm") for part in ("a", "b") if (tmp_path / part).mkdir() is None]
    assert robot_text(paths[0]) == robot_text(paths[1])


def test_an_arm_of_which_urdf_alone_is_known_closes_a_flap(tmp_path: Path) -> None:
    plan = plan_closing(draw_problem(11).model, saved(bare_urdf("franka_panda"), tmp_path), np.eye(4))
    assert plan.order == ("flap_1",)


def test_an_arm_whose_links_keep_apart_has_no_pair_that_may_touch(tmp_path: Path) -> None:
    file = robot_file(saved(chain_urdf(), tmp_path))
    assert file.may_touch == ()
    assert not any("may_touch" in line for line in file.assumptions)


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        ("ready_deg = [0, 0]", "<boxwright>: ready_deg has 2 values; one for each of 6 joints"),
        ("accelerations_deg_per_s2 = [9]", "<boxwright>: accelerations_deg_per_s2 has 1 values; one for each of 6"),
        ("redy_deg = [0]", "<boxwright>: Object contains unknown field `redy_deg`"),
        ("ready_deg = [", "<boxwright>: "),
        ('may_touch = [["l2", "l9"]]', "no link l9"),
        ("ready_deg = [0, 0, 0, 0, 0, 200]", "ready_deg: j6 at 200 is outside its limits"),
        ("ready_deg = [0, 0, 0, 0, 0, nan]", "<boxwright>: ready_deg[5] is nan; it must be a finite number"),
        (
            "opw = { a1_m = 0.05, a2_m = 0, b_m = 0, c1_m = 0.3, c2_m = 0.3, c3_m = 0.3, c4_m = 0.1, "
            "offsets_deg = [0, 0, 0, 0, 0, 0], signs = [1, 1, 1, 1, 1, 1] }",
            "<boxwright>: opw puts joint j2 elsewhere than its origin",
        ),
    ],
)
def test_what_is_wrong_in_our_own_element_is_told_by_its_key(inside: str, told: str, tmp_path: Path) -> None:
    path = saved(chain_urdf().replace("</robot>", f"{OURS}{inside}</boxwright></robot>"), tmp_path)
    with pytest.raises(ValueError, match=r".") as caught:
        load_robot(path)
    assert told in str(caught.value)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_what_our_own_element_tells_is_taken_and_the_rest_is_guessed(tmp_path: Path) -> None:
    told = chain_urdf().replace("</robot>", f"{OURS}ready_deg = [1, 2, 3, 4, 5, 6]</boxwright></robot>")
    file = robot_file(saved(told, tmp_path))
    assert file.ready_deg == (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)
    assert not any("ready_deg" in line for line in file.assumptions)
    assert any("gripper" in line for line in file.assumptions)


def test_an_arm_that_waits_inside_itself_is_refused_as_such_and_no_camera_pose_is_blamed(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    inside = msgspec.structs.replace(robot_file("franka_panda"), ready_deg=(0.0, 0.0, 0.0, -170.0, 0.0, 0.0, 0.0))
    path.write_text(toml_text(inside), encoding="utf-8")
    with pytest.raises(ValueError, match=r"mine\.toml: ready_deg: .* stands inside .*; .*may_touch") as caught:
        plan_closing(draw_problem(11).model, path, np.eye(4))
    assert "base_from_input" not in str(caught.value)
