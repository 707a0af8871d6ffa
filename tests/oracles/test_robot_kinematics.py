"""Arms: our forward and inverse against py-opw-kinematics and EAIK, and the written URDF in MuJoCo and yourdfpy."""

from __future__ import annotations

import io
import math

import mujoco
import numpy as np
import py_opw_kinematics
import pytest
import yourdfpy
from numpy.typing import NDArray
from scipy.spatial.transform import RigidTransform

from boxwright.robots import Robot, load_robot, robot_names, urdf_of_robot

Array = NDArray[np.float64]

POSES = 100_000
MATCHED = 2_000
URDF_POSES = 100
CLOSED = ("kuka_kr6_r700", "viper_s850")


def drawn(robot: Robot, count: int, seed: int) -> Array:
    """Positions (count, axes) within the limits, drawn evenly."""
    lower, upper = robot.limits_rad.T
    return np.random.default_rng(seed).uniform(lower, upper, (count, len(lower)))


def opw_of(robot: Robot) -> py_opw_kinematics.Robot:
    """The same arm as py-opw-kinematics has it."""
    opw = robot.file.opw
    assert opw is not None
    model = py_opw_kinematics.KinematicModel(
        a1=opw.a1_m,
        a2=opw.a2_m,
        b=opw.b_m,
        c1=opw.c1_m,
        c2=opw.c2_m,
        c3=opw.c3_m,
        c4=opw.c4_m,
        offsets=tuple(math.radians(angle) for angle in opw.offsets_deg),
        flip_axes=tuple(sign < 0 for sign in opw.signs),
    )
    return py_opw_kinematics.Robot(model, degrees=False)


def tool_offset(robot: Robot) -> RigidTransform:
    return RigidTransform.from_translation(robot.file.gripper.tool_point_m)


def test_closed_forms_are_there() -> None:
    assert tuple(name for name in robot_names() if load_robot(name).closed_form) == CLOSED


@pytest.mark.parametrize("name", CLOSED)
def test_their_forward_undoes_our_inverse(name: str) -> None:
    robot, theirs = load_robot(name), opw_of(load_robot(name))
    made = drawn(robot, POSES, seed=1)
    tools = robot.forward(made)
    found = [robot.arm.inverse(tool)[0] for tool in tools]
    counts = np.array([len(positions) for positions in found])
    assert counts.min() >= 1
    positions, wanted = np.concatenate(found), np.repeat(tools, counts, axis=0)
    reached = theirs.batch_forward(positions, ee_transform=tool_offset(robot)).as_matrix()
    assert np.abs(reached - wanted).max() < 1e-9
    lower, upper = robot.limits_rad.T
    assert ((positions >= lower) & (positions <= upper)).all()
    nearest = np.minimum.reduceat(
        np.abs(positions - np.repeat(made, counts, axis=0)).max(1), np.cumsum(counts) - counts
    )
    assert nearest.max() < 1e-5, "the position that a pose was made from is among its solutions"
    assert len(counts) == POSES


@pytest.mark.parametrize("name", CLOSED)
def test_our_branches_are_theirs(name: str) -> None:
    robot, theirs = load_robot(name), opw_of(load_robot(name))
    tools = robot.forward(drawn(robot, MATCHED, seed=2))
    branches = theirs.reach(RigidTransform.from_matrix(tools), ee_transform=tool_offset(robot)).joints
    matched = 0
    for tool, their_angles in zip(tools, branches, strict=True):
        ours = robot.inverse(tool)
        if ours.singular.any():
            continue
        within = [angles for angles in their_angles if not np.isnan(angles).any() and _wraps(robot, angles) > 0]
        assert sum(_wraps(robot, angles) for angles in within) == len(ours.positions)
        assert len(set(ours.branch)) == len(within)
        for positions in ours.positions:
            assert min(_turned(positions - angles) for angles in within) < 1e-6
        matched += 1
    assert matched > 0.8 * MATCHED


def test_eaik_finds_what_we_find() -> None:
    eaik = pytest.importorskip("eaik.IK_DH", reason="EAIK comes with the extra bench")
    robot = load_robot("viper_s850")
    # ViSP's table (vpViper850), metres and radians; its zero is ours less these offsets.
    alpha = np.radians([-90.0, 0.0, -90.0, 90.0, -90.0, 0.0])
    theirs = eaik.DhRobot(alpha, np.array([75, 365, 90, 0, 0, 0]) / 1e3, np.array([335, 0, 0, 405, 0, 80]) / 1e3)
    zero = np.radians([0.0, 0.0, -180.0, 0.0, 0.0, -180.0])
    tools = robot.forward(drawn(robot, MATCHED, seed=3))
    flange_from_tool = np.eye(4)
    flange_from_tool[:3, 3] = robot.file.gripper.tool_point_m
    matched = 0
    for tool in tools:
        ours = robot.inverse(tool)
        if ours.singular.any():
            continue
        answer = theirs.IK(tool @ np.linalg.inv(flange_from_tool))
        exact = [q - zero for q, least in zip(answer.Q, answer.is_LS, strict=True) if not least]
        within = [angles for angles in exact if _wraps(robot, angles) > 0]
        assert sum(_wraps(robot, angles) for angles in within) == len(ours.positions)
        for positions in ours.positions:
            assert min(_turned(positions - angles) for angles in within) < 1e-6
        matched += 1
    assert matched > 0.8 * MATCHED


@pytest.mark.parametrize("name", robot_names())
def test_the_urdf_stands_where_the_arm_does(name: str) -> None:
    robot = load_robot(name)
    text = urdf_of_robot(robot)
    theirs = yourdfpy.URDF.load(io.StringIO(text), build_scene_graph=True, load_meshes=False)
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    tool_body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, "tool")
    joints = [model.joint(joint) for joint in robot.joint_names]
    np.testing.assert_allclose([joint.range for joint in joints], robot.limits_rad, atol=1e-15)
    counted = 0
    for positions in drawn(robot, URDF_POSES, seed=4):
        tool = robot.forward(positions)
        theirs.update_cfg(dict(zip(robot.joint_names, positions, strict=True)))
        np.testing.assert_allclose(theirs.get_transform("tool"), tool, atol=1e-12)
        for joint, position in zip(joints, positions, strict=True):
            data.qpos[joint.qposadr[0]] = position
        mujoco.mj_kinematics(model, data)
        np.testing.assert_allclose(data.xpos[tool_body], tool[:3, 3], atol=1e-12)
        np.testing.assert_allclose(data.xmat[tool_body].reshape(3, 3), tool[:3, :3], atol=1e-12)
        counted += 1
    assert counted == URDF_POSES


@pytest.mark.parametrize("name", robot_names())
def test_the_urdf_weighs_what_the_file_says(name: str) -> None:
    robot = load_robot(name)
    model = mujoco.MjModel.from_xml_string(urdf_of_robot(robot))
    told = sum(link.mass_kg for link in robot.file.link) + robot.file.gripper.mass_kg
    assert model.body_mass.sum() == pytest.approx(told, rel=1e-12)


def test_the_panda_stands_where_its_denavit_hartenberg_table_has_it() -> None:
    robot = load_robot("franka_panda")
    # Franka Control Interface, Craig's convention: a, d in metres, alpha in degrees; the last row is the flange.
    table = [
        (0.0, 0.333, 0.0),
        (0.0, 0.0, -90.0),
        (0.0, 0.316, 90.0),
        (0.0825, 0.0, 90.0),
        (-0.0825, 0.384, -90.0),
        (0.0, 0.0, 90.0),
        (0.088, 0.0, 90.0),
        (0.0, 0.107, 0.0),
    ]
    for positions in drawn(robot, URDF_POSES, seed=5):
        by_table = np.eye(4)
        for (a, d, alpha_deg), theta in zip(table, [*positions, 0.0], strict=True):
            by_table = by_table @ _craig(a, d, math.radians(alpha_deg), theta)
        np.testing.assert_allclose(robot.link_frames(positions)[-1], by_table, atol=1e-12)


def _craig(a_m: float, d_m: float, alpha: float, theta: float) -> Array:
    sa, ca, st, ct = math.sin(alpha), math.cos(alpha), math.sin(theta), math.cos(theta)
    return np.array(
        [[ct, -st, 0, a_m], [st * ca, ct * ca, -sa, -d_m * sa], [st * sa, ct * sa, ca, d_m * ca], [0, 0, 0, 1]]
    )


def _wraps(robot: Robot, angles: Array) -> int:
    """In how many positions within limits these angles are reached."""
    lower, upper = robot.limits_rad.T
    return int(np.prod(np.floor((upper - angles) / math.tau) - np.ceil((lower - angles) / math.tau) + 1))


def _turned(difference: Array) -> float:
    """The largest angle of a difference, whole turns aside."""
    return float(np.abs(np.remainder(difference + math.pi, math.tau) - math.pi).max())
