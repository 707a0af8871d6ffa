"""A robot arm in MuJoCo: links, gripper, and position servos that drive it.

Servos: each joint is a critically damped spring of a stated bandwidth about its target, with the inertia that it has in
the ready pose; the target leads by what damping and inertia would lag. The arm's weight is borne, as controllers do. A
joint's torque is limited to TORQUE_SHARE times what the file's acceleration takes in the ready pose.
"""

from __future__ import annotations

from itertools import pairwise

import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.box_bodies import SOLID, contact_of
from boxwright.simulation.physics.robot_file import Link, RobotFile, turned
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.world import SUPPORT, ToolNames

Array = NDArray[np.float64]

BANDWIDTH_HZ = 15.0
"""Of the joints' position loops: a usual figure of industrial servos of this size, an assumption."""
TORQUE_SHARE = 4.0
ROTOR_KG_M2 = 0.1
"""Inertia of motor and gear as the joint feels it, an assumption."""
FINGER_BANDWIDTH_HZ = 30.0
FINGER_KG = 0.05
FINGER_DRIVE_KG = 0.5
FINGER_FORCE_N = 100.0

FINGERS = ("finger_left", "finger_right")
GRIPPER = "gripper"
BASE = "robot_base"
ARM_RGBA = (0.92, 0.92, 0.9, 1.0)
GRIPPER_RGBA = (0.35, 0.38, 0.42, 1.0)
FINGER_RGBA = (0.2, 0.45, 0.8, 1.0)


class Arm:
    """A `Tool` (world.py) made from a robot's file."""

    def __init__(self, robot: RobotFile) -> None:
        self.robot = robot
        self.name = robot.name

    def add_to(self, spec: mujoco.MjSpec, settings: PhysicsSettings, start: Array, opening_m: float) -> ToolNames:
        """Links, gripper and servos, in the world's frame; joints in the file's order, then the two fingers'."""
        robot = self.robot
        if len(start) != len(robot.joints):
            raise ValueError(f"robot {robot.name} has {len(robot.joints)} joints; the trajectory has {len(start)}")
        body = spec.worldbody.add_body(name=BASE)
        _add_shapes(body, robot.links[0], settings)
        names = [BASE]
        for (mount, axis), joint, link in zip(robot.mounts(), robot.joints, robot.links[1:], strict=True):
            body = body.add_body(name=link.name, pos=mount[:3, 3], quat=quaternion(mount), gravcomp=1.0)
            low, high = np.radians(joint.limits_deg)
            body.add_joint(
                name=joint.name,
                type=mujoco.mjtJoint.mjJNT_HINGE,
                axis=axis,
                armature=ROTOR_KG_M2,
                limited=mujoco.mjtLimited.mjLIMITED_TRUE,
                range=[low, high],
            )
            _add_servo(spec, joint.name)
            _add_shapes(body, link, settings)
            names.append(link.name)
        self._add_gripper(spec, body, settings)
        _exclude(spec, robot, names)
        return ToolNames(tuple(joint.name for joint in robot.joints), (GRIPPER, *FINGERS), (*names, GRIPPER, *FINGERS))

    def begin(self, model: mujoco.MjModel, data: mujoco.MjData, start: Array, opening_m: float) -> None:
        """Tunes the servos in the ready pose, then puts the joints at `start` and the fingers as wide open as told."""
        joints = [model.joint(joint.name) for joint in self.robot.joints]
        data.qpos[[joint.qposadr[0] for joint in joints]] = np.radians(self.robot.ready_deg)
        mujoco.mj_forward(model, data)
        inertia = np.zeros((model.nv, model.nv))
        mujoco.mj_fullM(model, data, inertia)
        for joint, told in zip(joints, self.robot.joints, strict=True):
            kg_m2 = float(inertia[joint.dofadr[0], joint.dofadr[0]])
            strongest = TORQUE_SHARE * kg_m2 * float(np.radians(told.acceleration_deg_per_s2))
            _tune(model, joint.name, kg_m2, BANDWIDTH_HZ, strongest)
        for finger in FINGERS:
            _tune(model, finger, FINGER_KG + FINGER_DRIVE_KG, FINGER_BANDWIDTH_HZ, FINGER_FORCE_N)
        data.qpos[[joint.qposadr[0] for joint in joints]] = start
        data.qpos[[model.joint(finger).qposadr[0] for finger in FINGERS]] = opening_m / 2.0
        data.ctrl[:] = np.concatenate([start, [opening_m / 2.0] * 2])

    def commands(self, positions: Array, velocities: Array, accelerations: Array, opening_m: float) -> Array:
        """(N, joints + 2): targets that lead by the lag of a critically damped spring."""
        rate = 2.0 * np.pi * BANDWIDTH_HZ
        leading = positions + 2.0 / rate * velocities + accelerations / rate**2
        return np.column_stack([leading, np.full((len(leading), 2), opening_m / 2.0)])

    def _add_gripper(self, spec: mujoco.MjSpec, last: mujoco.MjsBody, settings: PhysicsSettings) -> None:
        gripper, flange = self.robot.gripper, self.robot.last_link_from_flange()
        depth_m = gripper.body_size_m[2]
        body = last.add_body(name=GRIPPER, pos=flange[:3, 3], quat=quaternion(flange), gravcomp=1.0)
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=[0.0, 0.0, depth_m / 2.0],
            size=np.array(gripper.body_size_m) / 2.0,
            mass=gripper.mass_kg - 2.0 * FINGER_KG,
            rgba=GRIPPER_RGBA,
            **SOLID.as_geom(),
            **contact_of(settings, settings.friction_finger),
        )
        for name, side in zip(FINGERS, (1.0, -1.0), strict=True):
            size = np.array(gripper.finger_size_m)
            finger = body.add_body(name=name, pos=[0.0, side * size[1] / 2.0, depth_m + size[2] / 2.0], gravcomp=1.0)
            finger.add_joint(
                name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0.0, side, 0.0], armature=FINGER_DRIVE_KG
            )
            _add_servo(spec, name)
            finger.add_geom(
                type=mujoco.mjtGeom.mjGEOM_BOX,
                size=size / 2.0,
                mass=FINGER_KG,
                rgba=FINGER_RGBA,
                **SOLID.as_geom(),
                **contact_of(settings, settings.friction_finger),
            )


def quaternion(pose: Array) -> Array:
    """w, x, y, z of a pose's rotation, as MuJoCo has it."""
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.ascontiguousarray(pose[:3, :3]).reshape(9))
    return quat


def _add_shapes(body: mujoco.MjsBody, link: Link, settings: PhysicsSettings) -> None:
    """The link's shapes, its mass shared out by their volumes."""
    capsules = [np.pi * c.radius_m**2 * (_length(c.start_m, c.end_m) + 4.0 / 3.0 * c.radius_m) for c in link.capsules]
    volumes = [*capsules, *(float(np.prod(box.size_m)) for box in link.boxes)]
    kg_per_m3 = link.mass_kg / sum(volumes)
    common = {"rgba": ARM_RGBA, **SOLID.as_geom(), **contact_of(settings, settings.friction_finger)}
    for capsule, volume in zip(link.capsules, volumes, strict=False):
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=[*capsule.start_m, *capsule.end_m],
            size=[capsule.radius_m, 0.0, 0.0],
            mass=kg_per_m3 * volume,
            **common,
        )
    for box, volume in zip(link.boxes, volumes[len(link.capsules) :], strict=True):
        pose = turned(box.centre_m, box.rpy_deg)
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=pose[:3, 3],
            quat=quaternion(pose),
            size=np.array(box.size_m) / 2.0,
            mass=kg_per_m3 * volume,
            **common,
        )


def _length(start: tuple[float, float, float], end: tuple[float, float, float]) -> float:
    return float(np.linalg.norm(np.subtract(end, start)))


def _add_servo(spec: mujoco.MjSpec, joint: str) -> None:
    """A position servo whose gains `_tune` sets once the inertias are known."""
    spec.add_actuator(
        name=joint,
        target=joint,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        gaintype=mujoco.mjtGain.mjGAIN_FIXED,
        biastype=mujoco.mjtBias.mjBIAS_AFFINE,
        forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
        forcerange=[-1.0, 1.0],
    )


def _tune(model: mujoco.MjModel, name: str, inertia: float, bandwidth_hz: float, strongest: float) -> None:
    actuator, rate = model.actuator(name), 2.0 * np.pi * bandwidth_hz
    actuator.gainprm[0] = rate**2 * inertia
    actuator.biasprm[1] = -(rate**2) * inertia
    actuator.biasprm[2] = -2.0 * rate * inertia
    actuator.forcerange[:] = [-strongest, strongest]


def _exclude(spec: mujoco.MjSpec, robot: RobotFile, names: list[str]) -> None:
    """Neighbours, what the file says may touch, the base on whatever it stands on, and finger on finger."""
    bodies = {"gripper": (GRIPPER,), "fingers": FINGERS}
    bodies |= {link.name: (name,) for link, name in zip(robot.links, names, strict=True)}
    pairs = [*pairwise(names), (names[-1], GRIPPER), (BASE, SUPPORT), FINGERS]
    pairs += [(GRIPPER, finger) for finger in FINGERS]
    for first, second in robot.may_touch:
        pairs += [(one, other) for one in bodies[first] for other in bodies[second]]
    for first, second in sorted({tuple(sorted(pair)) for pair in pairs}):
        spec.add_exclude(bodyname1=first, bodyname2=second)
