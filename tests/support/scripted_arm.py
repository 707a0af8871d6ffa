"""An arm that follows a finger's script: joint positions by damped least squares on MuJoCo's own Jacobians.

Independent of the project's inverse kinematics and planner. It knows no obstacle and fits only where none is.
"""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.arm import GRIPPER, Arm
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.types import PlanSegment

Array = NDArray[np.float64]

ROUNDS = 200
DAMPING = 1e-4
NEAR_M = 1e-5


class ScriptedArm:
    """Keeps the tool point on a path and the tool's z axis straight down."""

    def __init__(self, arm: Arm) -> None:
        spec = mujoco.MjSpec()
        spec.compiler.degree = False
        spec.worldbody.add_body(name="support")
        self.ready = np.radians(arm.robot.ready_deg)
        self._names = arm.add_to(spec, PhysicsSettings(), self.ready, 0.0).joints
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._tool_m = np.array(arm.robot.gripper.tool_point_m)
        self._at = [int(self._model.joint(name).qposadr[0]) for name in self._names]

    def follow(self, segments: Sequence[PlanSegment]) -> list[PlanSegment]:
        """The same segments in joint positions; speeds are the differences of neighbours, zero at each end."""
        joints, made = self.ready, []
        for segment in segments:
            rows = []
            for place in segment.positions:
                joints = self._reach(joints, np.array(place))
                rows.append(joints)
            times, positions = np.array(segment.times), np.array(rows)
            speeds = np.zeros_like(positions)
            speeds[1:-1] = (positions[2:] - positions[:-2]) / (times[2:] - times[:-2])[:, None]
            made.append(
                msgspec.structs.replace(
                    segment,
                    positions=tuple(map(tuple, positions.tolist())),
                    velocities=tuple(map(tuple, speeds.tolist())),
                )
            )
        return made

    def _reach(self, joints: Array, target: Array) -> Array:
        model, data, body = self._model, self._data, self._model.body(GRIPPER).id
        joints = joints.copy()
        move, turn = np.zeros((3, model.nv)), np.zeros((3, model.nv))
        for _ in range(ROUNDS):
            data.qpos[self._at] = joints
            mujoco.mj_fwdPosition(model, data)
            axes = data.xmat[body].reshape(3, 3)
            tip = data.xpos[body] + axes @ self._tool_m
            error = np.concatenate([target - tip, np.cross(axes[:, 2], [0.0, 0.0, -1.0])])
            if axes[2, 2] > -0.2:
                error[3:] += 0.3 * axes[:, 1]
            if np.linalg.norm(error) < NEAR_M:
                return joints
            mujoco.mj_jac(model, data, move, turn, tip, body)
            jacobian = np.vstack([move, turn])[:, self._at]
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + DAMPING * np.eye(6), error)
            joints += np.clip(step, -0.2, 0.2)
        raise AssertionError(f"the scripted arm does not reach {target}; error {np.round(error, 4)}")
