"""The arm in physics: where its file says it is, following its course, and pushing a flap shut."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
import pytest

from boxwright.robots import load_robot as core_robot
from boxwright.robots import robot_names
from boxwright.simulation.physics import (
    Arm,
    Load,
    PhysicsSettings,
    Session,
    crease_class,
    load_robot,
    simulate_closing,
    true_box,
)
from boxwright.simulation.physics.commands import course_of, held
from boxwright.simulation.physics.stage import Stage
from boxwright.simulation.physics.world import World, build_world
from boxwright.types import PlanSegment
from support.finger import push_shut
from support.scripted_arm import ScriptedArm
from support.true_boxes import carton, truth_of


@pytest.fixture(scope="module")
def arm() -> Arm:
    return Arm(load_robot("viper_s850"))


BOX = true_box(truth_of(carton(), x_m=0.9, z_m=-0.3), 0, np.eye(4))


def beside_a_box(arm: Arm, start: np.ndarray, opening_m: float = 0.0) -> World:
    return build_world(BOX, crease_class("ordinary"), PhysicsSettings(), tool=(arm, start, opening_m))


def test_the_flange_is_where_the_data_sheet_s_lengths_put_it(arm: Arm) -> None:
    """Standard DH of the Viper s850, told apart from its ortho-parallel form: a, alpha, d, theta's offset."""
    table = [
        (0.075, -90, 0.335, 0),
        (0.365, 0, 0, 0),
        (0.090, -90, 0, -180),
        (0, 90, 0.405, 0),
        (0, -90, 0, 0),
        (0, 0, 0.080, -180),
    ]
    world = beside_a_box(arm, np.zeros(6))
    data, rng = mujoco.MjData(world.model), np.random.default_rng(1)
    for _ in range(50):
        joints = rng.uniform(*np.radians([joint.limits_deg for joint in arm.robot.joint]).T)
        data.qpos[[world.model.joint(joint.name).qposadr[0] for joint in arm.robot.joint]] = joints
        mujoco.mj_kinematics(world.model, data)
        wanted = np.eye(4)
        for (a, alpha_deg, d, offset_deg), q in zip(table, joints, strict=True):
            theta, alpha = q + np.radians(offset_deg), np.radians(alpha_deg)
            c, s, ca, sa = np.cos(theta), np.sin(theta), np.cos(alpha), np.sin(alpha)
            wanted = wanted @ [[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]]
        np.testing.assert_allclose(data.body("gripper").xpos, wanted[:3, 3], atol=1e-12)
        np.testing.assert_allclose(data.body("gripper").xmat.reshape(3, 3)[:, 2], wanted[:3, 2], atol=1e-12)


@pytest.mark.parametrize("name", robot_names())
def test_every_shipped_robot_stands_and_is_where_the_core_has_it(name: str) -> None:
    """Planning's kinematics are the core's; physics works out by itself where a robot's joints are."""
    robot, core = Arm(load_robot(name)), core_robot(name)
    ready = np.radians(robot.robot.ready_deg)
    world = beside_a_box(robot, ready)
    stage = Stage(world, BOX)
    stage.follow(held(ready, 0.2, 0.001))
    assert stage.max_joint_error_rad < 1e-3
    assert not stage.watch.unwanted()
    data, rng = mujoco.MjData(world.model), np.random.default_rng(4)
    at = [world.model.joint(joint.name).qposadr[0] for joint in robot.robot.joint]
    for _ in range(20):
        joints = rng.uniform(*np.radians([joint.limits_deg for joint in robot.robot.joint]).T)
        data.qpos[at] = joints
        mujoco.mj_kinematics(world.model, data)
        gripper = data.body("gripper")
        turn = gripper.xmat.reshape(3, 3)
        tool = gripper.xpos + turn @ np.array(robot.robot.gripper.tool_point_m)
        wanted = core.forward(joints)
        np.testing.assert_allclose(tool, wanted[:3, 3], atol=1e-9)
        np.testing.assert_allclose(turn, wanted[:3, :3], atol=1e-9)


def test_fingers_open_as_far_as_told_and_reach_the_tool_point(arm: Arm) -> None:
    start = np.radians(arm.robot.ready_deg)
    world = beside_a_box(arm, start, 0.05)
    stage = Stage(world, BOX)
    stage.follow(held(start, 0.2, 0.001), 0.05)
    left, right = (stage.data.body(name).xpos for name in ("finger_left", "finger_right"))
    assert np.linalg.norm(left - right) == pytest.approx(0.05 + 0.01, abs=1e-4)
    tip = (left + right) / 2 + 0.04 * stage.data.body("gripper").xmat.reshape(3, 3)[:, 2]
    flange = stage.data.body("gripper")
    np.testing.assert_allclose(flange.xmat.reshape(3, 3).T @ (tip - flange.xpos), [0, 0, 0.15], atol=1e-4)


def test_joints_follow_a_quick_course_within_a_sixth_of_a_degree(arm: Arm) -> None:
    start = np.radians(arm.robot.ready_deg)
    times = np.linspace(0.0, 1.0, 51)
    swing = np.radians([40, 30, -30, 40, 40, 60])
    positions = start + (1 - np.cos(np.pi * times))[:, None] / 2 * swing
    velocities = np.pi / 2 * np.sin(np.pi * times)[:, None] * swing
    segment = PlanSegment(
        flap=None,
        kind="transit",
        times=tuple(times.tolist()),
        positions=tuple(map(tuple, positions.tolist())),
        velocities=tuple(map(tuple, velocities.tolist())),
        gripper_opening_m=0.0,
    )
    stage = Stage(beside_a_box(arm, start), BOX)
    stage.follow(course_of(segment, 0.001))
    assert np.degrees(stage.max_joint_error_rad) < 1 / 6
    assert not stage.watch.unwanted()


def test_the_arm_pushes_a_flap_shut(arm: Arm) -> None:
    box = true_box(truth_of(carton(), x_m=0.6, z_m=-0.1, yaw_rad=np.pi / 2), 0, np.eye(4))
    segments = ScriptedArm(arm).follow(push_shut(box, "flap_1", -8.0, radius_m=0.011))
    simulation = simulate_closing(box, arm, segments).simulation
    assert simulation.failure is None
    assert not simulation.unwanted
    assert simulation.flaps["flap_1"].closed
    assert simulation.flaps["flap_1"].held
    assert simulation.max_force_n > 0.5
    assert np.degrees(simulation.max_joint_error_rad) < 0.5


def test_an_arm_that_presses_too_hard_is_stopped_there(arm: Arm) -> None:
    """A flap that lies on a flat box's base already is pushed on."""
    flat = msgspec.structs.replace(carton(), height_m=0.05)
    box = true_box(truth_of(flat, x_m=0.6, z_m=-0.1, yaw_rad=np.pi / 2), 0, np.eye(4))
    segments = ScriptedArm(arm).follow(push_shut(box, "flap_1", -40.0, radius_m=0.011))
    short, on = (
        simulate_closing(box, arm, segments, load=Load(mass_kg=4.0), settings=settings).simulation
        for settings in (PhysicsSettings(), PhysicsSettings(most_force_n=1e6))
    )
    stopped = short.stopped
    assert stopped is not None
    assert on.stopped is None
    assert on.max_force_n > 1.2 * short.max_force_n
    assert (stopped.flap, stopped.limit_n) == ("flap_1", PhysicsSettings().most_force_n)
    assert stopped.pair in {("finger_left", "flap_1"), ("finger_right", "flap_1")}
    assert stopped.limit_n < stopped.force_n <= short.max_force_n < 1.5 * stopped.limit_n
    # On the flap's inner part, within the box's footprint and near its base.
    np.testing.assert_allclose(stopped.at_m, [0.6, 0.08, -0.08], atol=0.03)
    # It stays there: the rest of the course is not followed, but what was reached is judged.
    assert short.simulated_s == pytest.approx(stopped.at_s + PhysicsSettings().rest_s, abs=0.01)
    assert short.simulated_s < on.simulated_s - 1.0
    assert short.failure is None
    assert not short.unwanted
    assert on.flaps["flap_1"].closed
    assert not short.flaps["flap_1"].closed
    assert short.flaps["flap_1"].after_rad == pytest.approx(short.flaps["flap_1"].pushed_to_rad, abs=0.02)
    line = stopped.line()
    for part in ("flap_1", stopped.pair[0], f"{stopped.force_n:.0f} N", "more than 250 N", "-0.079"):
        assert part in line, line


def test_a_stopped_arm_follows_nothing_any_more(arm: Arm) -> None:
    flat = msgspec.structs.replace(carton(), height_m=0.05)
    box = true_box(truth_of(flat, x_m=0.6, z_m=-0.1, yaw_rad=np.pi / 2), 0, np.eye(4))
    segments = ScriptedArm(arm).follow(push_shut(box, "flap_1", -40.0, radius_m=0.011))
    session = Session(box, arm, np.array(segments[0].positions[0]), crease_class("ordinary"), load=Load(mass_kg=4.0))
    session.follow(segments)
    before = session.verdict("ordinary", "true")
    session.follow(segments)
    after = session.verdict("ordinary", "true")
    assert before.stopped is not None
    assert after.simulated_s == before.simulated_s
    assert after.flaps == before.flaps


def test_the_arm_s_mjcf_reads_back_as_the_same_arm(arm: Arm) -> None:
    """MuJoCo writes six digits."""
    model = mujoco.MjModel.from_xml_string(arm.mjcf_text())
    world = beside_a_box(arm, np.zeros(6)).model
    here, there, rng = mujoco.MjData(model), mujoco.MjData(world), np.random.default_rng(2)
    names = [joint.name for joint in arm.robot.joint]
    assert [model.actuator(k).name for k in range(model.nu)] == [*names, "finger_left", "finger_right"]
    for _ in range(20):
        joints = rng.uniform(-1.0, 1.0, len(names))
        for data, one in ((here, model), (there, world)):
            data.qpos[[one.joint(name).qposadr[0] for name in names]] = joints
            mujoco.mj_kinematics(one, data)
        for body in ("link_2", "link_4", "gripper", "finger_left"):
            np.testing.assert_allclose(here.body(body).xpos, there.body(body).xpos, atol=1e-5)
            np.testing.assert_allclose(here.body(body).xmat, there.body(body).xmat, atol=1e-5)
    for name in names:
        np.testing.assert_allclose(model.joint(name).range, world.joint(name).range, rtol=1e-5)
        np.testing.assert_allclose(model.actuator(name).gainprm, world.actuator(name).gainprm, rtol=1e-5)
        np.testing.assert_allclose(model.actuator(name).forcerange, world.actuator(name).forcerange, rtol=1e-5)


def test_robots_that_do_not_fit_are_refused(arm: Arm, tmp_path) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(ValueError, match=r"must be one of .*viper_s850"):
        load_robot("viper")
    path = tmp_path / "arm.toml"
    path.write_text('format = "boxwright.robot"\nversion = 1\n', encoding="utf-8")
    with pytest.raises(ValueError, match=r"arm\.toml: .*name"):
        load_robot(path)
    with pytest.raises(ValueError, match="has 6 joints"):
        beside_a_box(arm, np.zeros(5))
