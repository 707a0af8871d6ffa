"""A finger on three rails that pushes a flap shut by a script: physics without a robot and without a planner."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import Board, BoardBox
from boxwright.simulation.physics.box_bodies import contact_of
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.world import ToolNames
from boxwright.types import PlanSegment

Array = NDArray[np.float64]

RADIUS_M = 0.008
LENGTH_M = 0.3
RAILS = ("rail_x", "rail_y", "rail_z")
PER_SECOND = 20


class Finger:
    """A round rod that hangs down; its joints are where the middle of its round end is, world frame."""

    name = "finger"
    gain_n_per_m = 5000.0
    damping_n_s_per_m = 100.0
    strongest_n = 40.0

    def add_to(self, spec: mujoco.MjSpec, settings: PhysicsSettings, start: Array, opening_m: float) -> ToolNames:
        body = spec.worldbody.add_body(name="finger", pos=start, gravcomp=1.0)
        for k, rail in enumerate(RAILS):
            body.add_joint(name=rail, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=np.eye(3)[k], ref=start[k], armature=0.2)
            spec.add_actuator(
                name=rail,
                target=rail,
                trntype=mujoco.mjtTrn.mjTRN_JOINT,
                gaintype=mujoco.mjtGain.mjGAIN_FIXED,
                biastype=mujoco.mjtBias.mjBIAS_AFFINE,
                gainprm=[self.gain_n_per_m, *[0.0] * 9],
                biasprm=[0.0, -self.gain_n_per_m, -self.damping_n_s_per_m, *[0.0] * 7],
                forcelimited=mujoco.mjtLimited.mjLIMITED_TRUE,
                forcerange=[-self.strongest_n, self.strongest_n],
            )
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=[0.0, 0.0, 0.0, 0.0, 0.0, LENGTH_M],
            size=[RADIUS_M, 0.0, 0.0],
            mass=0.1,
            **contact_of(settings, settings.friction_finger),
        )
        return ToolNames(RAILS, ("finger",), ("finger",))

    def begin(self, model: mujoco.MjModel, data: mujoco.MjData, start: Array, opening_m: float) -> None:
        data.ctrl[:] = start

    def commands(self, positions: Array, velocities: Array, accelerations: Array, opening_m: float) -> Array:
        return positions + self.damping_n_s_per_m / self.gain_n_per_m * velocities


def push_shut(
    box: BoardBox,
    flap: str,
    to_deg: float,
    *,
    reach: float = 0.8,
    radius_m: float = RADIUS_M,
    start: tuple[float, Array] | None = None,
) -> list[PlanSegment]:
    """Approach, push along the flap's outer face at `reach` of its length down to an angle, and away upwards.

    `start` is the time and place at which the finger begins; else it begins where the approach does.
    """
    board = box.board(flap)
    assert board.hinge is not None
    angles = np.radians(np.arange(np.degrees(board.hinge.position_rad), to_deg - 1e-9, -2.0))
    path = np.array([_beside(board, box, angle, reach, radius_m) for angle in angles])
    above = path[0] + 0.05 * (path[0] - _on(board, box, angles[0], reach)) / radius_m
    t0, place = start or (0.0, above + 0.1 * box.up)
    high = np.array([*above[:2], max(above[2], place[2])])
    away = path[-1] + 0.25 * box.up
    pieces = [] if start is None else [(None, "transit", [place, np.array([*place[:2], high[2] + 0.1]), high])]
    pieces += [
        (flap, "approach", [pieces[-1][2][-1] if pieces else place, above, path[0]]),
        (flap, "push", list(path)),
        (flap, "retreat", [path[-1], away]),
    ]
    segments = []
    for name, kind, points in pieces:
        segments.append(_segment(name, kind, t0, np.array(points), angles))
        t0 = segments[-1].times[-1]
    return segments


def _on(board: Board, box: BoardBox, angle_rad: float, reach: float) -> Array:
    """The point of the middle of the flap, at a share of its length, when it stands at an angle."""
    hinge = board.hinge
    assert hinge is not None
    length_m = float(np.linalg.norm((board.corners[2] + board.corners[3]) / 2.0 - hinge.origin))
    inward = np.cross(box.world_from_box[:3, 2], hinge.axis)
    along = np.cos(angle_rad) * inward + np.sin(angle_rad) * box.world_from_box[:3, 2]
    return hinge.origin + reach * length_m * along


def _beside(board: Board, box: BoardBox, angle_rad: float, reach: float, radius_m: float) -> Array:
    """Where the finger's end touches the outer face there."""
    hinge = board.hinge
    assert hinge is not None
    inward = np.cross(box.world_from_box[:3, 2], hinge.axis)
    outward = -np.sin(angle_rad) * inward + np.cos(angle_rad) * box.world_from_box[:3, 2]
    return _on(board, box, angle_rad, reach) + (radius_m + box.thickness_m / 2.0) * outward


def _segment(flap: str | None, kind: str, t0: float, points: Array, angles: Sequence[float] | Array) -> PlanSegment:
    """Through the points at about 0.15 m/s, the speed as the differences of neighbours, zero at both ends."""
    legs = np.maximum(np.linalg.norm(np.diff(points, axis=0), axis=1) / 0.15, 0.02)
    times = t0 + np.concatenate([[0.0], np.cumsum(legs)])
    speed = np.zeros_like(points)
    speed[1:-1] = (points[2:] - points[:-2]) / (times[2:] - times[:-2])[:, None]
    pushing = kind == "push"
    return PlanSegment(
        flap=flap,
        kind=kind,  # type: ignore[arg-type]
        times=tuple(times.tolist()),
        positions=tuple(map(tuple, points.tolist())),
        velocities=tuple(map(tuple, speed.tolist())),
        gripper_opening_m=0.0,
        hinge_angle_rad=tuple(float(angle) for angle in angles) if pushing else None,
        contact=tuple(map(tuple, points.tolist())) if pushing else None,
    )
