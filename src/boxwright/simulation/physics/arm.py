"""A robot arm in MuJoCo: links, gripper, and position servos that drive it.

Servos: each joint is a critically damped spring of a stated bandwidth about its target, with the inertia that it has in
the ready pose; the target leads by what damping and inertia would lag. The arm's weight is borne, as controllers do. A
joint's torque is limited to TORQUE_SHARE times what the file's acceleration takes in the ready pose.
"""

from __future__ import annotations

from itertools import pairwise

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.box_bodies import SOLID, contact_of
from boxwright.simulation.physics.robot_file import last_link_from_flange, mounts, turned
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.world import SUPPORT, ToolNames
from boxwright.types import RobotFile, RobotLink

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


class Servo(msgspec.Struct, frozen=True):
    """A position servo: force = stiffness (target - position) - damping speed, at most `strongest`; SI units."""

    stiffness: float
    damping: float
    strongest: float


class Arm:
    """A `Tool` (world.py) made from a robot's file."""

    def __init__(self, robot: RobotFile) -> None:
        self.robot = robot
        self.name = robot.name
        self.servos = self._tuned()

    def add_to(self, spec: mujoco.MjSpec, settings: PhysicsSettings, start: Array, opening_m: float) -> ToolNames:
        """Links, gripper and servos, in the world's frame; joints in the file's order, then the two fingers'."""
        if len(start) != len(self.robot.joint):
            raise ValueError(f"robot {self.name} has {len(self.robot.joint)} joints; the trajectory has {len(start)}")
        names = self._add_bodies(spec, settings)
        _exclude(spec, self.robot, names)
        spec.add_exclude(bodyname1=BASE, bodyname2=SUPPORT)
        for name, servo in self.servos.items():
            _add_servo(spec, name, servo)
        joints = tuple(joint.name for joint in self.robot.joint)
        return ToolNames(joints, (GRIPPER, *FINGERS), (*names, GRIPPER, *FINGERS))

    def begin(self, model: mujoco.MjModel, data: mujoco.MjData, start: Array, opening_m: float) -> None:
        """Puts the joints at `start` and the fingers as wide open as told."""
        data.qpos[[model.joint(joint.name).qposadr[0] for joint in self.robot.joint]] = start
        data.qpos[[model.joint(finger).qposadr[0] for finger in FINGERS]] = opening_m / 2.0
        data.ctrl[:] = np.concatenate([start, [opening_m / 2.0] * 2])

    def commands(self, positions: Array, velocities: Array, accelerations: Array, opening_m: float) -> Array:
        """(N, joints + 2): targets that lead by the lag of a critically damped spring."""
        rate = 2.0 * np.pi * BANDWIDTH_HZ
        leading = positions + 2.0 / rate * velocities + accelerations / rate**2
        return np.column_stack([leading, np.full((len(leading), 2), opening_m / 2.0)])

    def mjcf_text(self) -> str:
        """The arm alone as MJCF, servos and all; metres, radians, kilograms, in six digits as MuJoCo writes them."""
        spec = mujoco.MjSpec()
        spec.modelname = self.name
        spec.compiler.degree = False
        names = self._add_bodies(spec, PhysicsSettings())
        _exclude(spec, self.robot, names)
        for name, servo in self.servos.items():
            _add_servo(spec, name, servo)
        spec.compile()
        return str(spec.to_xml())

    def _tuned(self) -> dict[str, Servo]:
        """Servos by their joints' names, from the inertia that each joint has in the ready pose."""
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        self._add_bodies(spec, PhysicsSettings())
        model = spec.compile()
        data, inertia = mujoco.MjData(model), np.zeros((model.nv, model.nv))
        data.qpos[[model.joint(joint.name).qposadr[0] for joint in self.robot.joint]] = np.radians(self.robot.ready_deg)
        mujoco.mj_forward(model, data)
        mujoco.mj_fullM(model, data, inertia)
        servos = {}
        for joint in self.robot.joint:
            at = int(model.joint(joint.name).dofadr[0])
            kg_m2 = float(inertia[at, at])
            strongest = TORQUE_SHARE * kg_m2 * float(np.radians(joint.acceleration_deg_per_s2))
            servos[joint.name] = _servo(kg_m2, BANDWIDTH_HZ, strongest)
        finger = _servo(FINGER_KG + FINGER_DRIVE_KG, FINGER_BANDWIDTH_HZ, FINGER_FORCE_N)
        return servos | dict.fromkeys(FINGERS, finger)

    def _add_bodies(self, spec: mujoco.MjSpec, settings: PhysicsSettings) -> list[str]:
        """The links' bodies, each on the one before, then the gripper; the links' names."""
        robot = self.robot
        body = spec.worldbody.add_body(name=BASE)
        _add_shapes(body, robot.link[0], settings)
        names = [BASE]
        for (mount, axis), joint, link in zip(mounts(robot), robot.joint, robot.link[1:], strict=True):
            body = body.add_body(name=link.name, pos=mount[:3, 3], quat=quaternion(mount), gravcomp=1.0)
            body.add_joint(
                name=joint.name,
                type=mujoco.mjtJoint.mjJNT_HINGE,
                axis=axis,
                armature=ROTOR_KG_M2,
                limited=mujoco.mjtLimited.mjLIMITED_TRUE,
                range=np.radians(joint.limits_deg),
            )
            _add_shapes(body, link, settings)
            names.append(link.name)
        self._add_gripper(body, settings)
        return names

    def _add_gripper(self, last: mujoco.MjsBody, settings: PhysicsSettings) -> None:
        gripper, flange = self.robot.gripper, last_link_from_flange(self.robot)
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


def _add_shapes(body: mujoco.MjsBody, link: RobotLink, settings: PhysicsSettings) -> None:
    """The link's shapes, its mass shared out by their volumes."""
    capsules = [np.pi * c.radius_m**2 * (_length(c.from_m, c.to_m) + 4.0 / 3.0 * c.radius_m) for c in link.capsules]
    volumes = [*capsules, *(float(np.prod(box.size_m)) for box in link.boxes)]
    kg_per_m3 = link.mass_kg / sum(volumes)
    common = {"rgba": ARM_RGBA, **SOLID.as_geom(), **contact_of(settings, settings.friction_finger)}
    for capsule, volume in zip(link.capsules, volumes, strict=False):
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=[*capsule.from_m, *capsule.to_m],
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


def _servo(inertia: float, bandwidth_hz: float, strongest: float) -> Servo:
    """A critically damped spring of that bandwidth on that inertia (kg m2, or kg)."""
    rate = 2.0 * np.pi * bandwidth_hz
    return Servo(rate**2 * inertia, 2.0 * rate * inertia, strongest)


def _add_servo(spec: mujoco.MjSpec, joint: str, servo: Servo) -> None:
    spec.add_actuator(
        name=joint,
        target=joint,
        trntype=mujoco.mjtTrn.mjTRN_JOINT,
        gaintype=mujoco.mjtGain.mjGAIN_FIXED,
        biastype=mujoco.mjtBias.mjBIAS_AFFINE,
        gainprm=[servo.stiffness, *[0.0] * 9],
        biasprm=[0.0, -servo.stiffness, -servo.damping, *[0.0] * 7],
        forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
        forcerange=[-servo.strongest, servo.strongest],
    )


def _exclude(spec: mujoco.MjSpec, robot: RobotFile, names: list[str]) -> None:
    """Neighbours, what the file says may touch, and finger on finger."""
    bodies = {"gripper": (GRIPPER,), "fingers": FINGERS}
    bodies |= {link.name: (name,) for link, name in zip(robot.link, names, strict=True)}
    pairs = [*pairwise(names), (names[-1], GRIPPER), FINGERS]
    pairs += [(GRIPPER, finger) for finger in FINGERS]
    for first, second in robot.may_touch:
        pairs += [(one, other) for one in bodies[first] for other in bodies[second]]
    for first, second in sorted({tuple(sorted(pair)) for pair in pairs}):
        spec.add_exclude(bodyname1=first, bodyname2=second)
