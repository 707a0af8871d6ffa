"""A plan held against speeds, accelerations, limits and clearances every millisecond, by another collision library."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import coal
import numpy as np
from numpy.typing import NDArray

from boxwright.types import Joint, Model, Part, Plan, PlanSegment
from support.arm_geometry import ArmShape, arm_shapes

Array = NDArray[np.float64]

STEP_S = 0.001
CLOSED_RAD = np.radians(15.0)


@dataclass(frozen=True)
class Dense:
    """A segment each millisecond: positions, velocities, accelerations (S, J), the hinge's angle (S,) or None."""

    positions: Array
    velocities: Array
    accelerations: Array
    hinge_rad: Array | None


def dense(segment: PlanSegment) -> Dense:
    """The cubics through the samples' positions and velocities."""
    times = np.array(segment.times)
    at = np.append(np.arange(times[0], times[-1], STEP_S), times[-1])
    k = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    span = (times[k + 1] - times[k])[:, None]
    s = ((at - times[k])[:, None]) / span
    q, v = np.array(segment.positions), np.array(segment.velocities)
    p0, p1, m0, m1 = q[k], q[k + 1], v[k] * span, v[k + 1] * span
    positions = (
        (2 * s**3 - 3 * s**2 + 1) * p0 + (s**3 - 2 * s**2 + s) * m0 + (3 * s**2 - 2 * s**3) * p1 + (s**3 - s**2) * m1
    )
    velocities = ((6 * s**2 - 6 * s) * (p0 - p1) + (3 * s**2 - 4 * s + 1) * m0 + (3 * s**2 - 2 * s) * m1) / span
    accelerations = ((12 * s - 6) * (p0 - p1) + (6 * s - 4) * m0 + (6 * s - 2) * m1) / span**2
    hinge = None if segment.hinge_angle_rad is None else np.interp(at, times, segment.hinge_angle_rad)
    return Dense(positions, velocities, accelerations, hinge)


def board(corners: Array, thickness_m: float) -> coal.ConvexBase:
    """The board between mid-board corners (4, 3), its own shape and no larger."""
    normal = np.cross(corners[2] - corners[0], corners[3] - corners[1])
    normal *= thickness_m / 2 / np.linalg.norm(normal)
    points = coal.StdVec_Vec3s()
    for corner in np.concatenate([corners + normal, corners - normal]):
        points.append(corner)
    return coal.Convex.convexHull(points, False, "")


def turned(part: Part, joint: Joint, angle_rad: float) -> Array:
    """A flap's corners (4, 3) at an angle."""
    turn = coal_rotation(np.array(joint.axis), angle_rad - joint.position)
    return (np.array(part.corners) - joint.origin) @ turn.T + joint.origin


def coal_rotation(axis: Array, angle_rad: float) -> Array:
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1 - np.cos(angle_rad)) * cross @ cross


class Clearances:
    """Least distances between an arm and a model's boards, as a plan goes along."""

    def __init__(self, model: Model, robot: Path) -> None:
        self.box = model.objects[0]
        self.robot = robot
        self.support_m = None if model.support_plane is None else model.support_plane.distance
        self.joints = {joint.child: joint for joint in self.box.joints if not joint.child.startswith("tuck")}

    def of_plan(self, plan: Plan) -> list[tuple[str, float]]:
        """For each segment the least distance of any body to anything, and of the fingers to the pushed flap apart."""
        closed: dict[str, float] = {}
        found = []
        pushes = [segment for segment in plan.segments if segment.kind == "push"]
        for segment in plan.segments:
            found += self._of_segment(segment, closed)
            if segment.kind == "push" and segment.flap is not None:
                pushes.pop(0)
                # Turned in stages, it is left where the next begins.
                then = pushes[0].hinge_angle_rad if pushes and pushes[0].flap == segment.flap else None
                closed[segment.flap] = then[0] if then else plan.flaps[segment.flap].rest_rad or 0.0
        return found

    def _of_segment(self, segment: PlanSegment, closed: dict[str, float]) -> list[tuple[str, float]]:
        moves = dense(segment)
        shapes = arm_shapes(self.robot, moves.positions, segment.gripper_opening_m)
        still = [np.array(part.corners) for part in self.box.parts if part.name not in self.joints and part.corners]
        still = [corners for corners, part in zip(still, self._fixed(), strict=True) if part]
        # Flaps that are closed give way to what is pushed onto them: only the arm in free space is held against them.
        others = [
            turned(self.box.part(name), joint, closed.get(name, joint.position))
            for name, joint in self.joints.items()
            if name != segment.flap and not (name in closed and segment.kind != "transit")
        ]
        least = min(self._least(shape, corners) for shape in shapes for corners in still + others)
        found = [(f"{segment.kind} {segment.flap}", min(least, self._above_support(shapes)))]
        if segment.kind == "push" and moves.hinge_rad is not None and segment.flap is not None:
            fingers = [shape for shape in shapes if shape.body == "fingers"]
            found.append(("finger", self._to_pushed(fingers, segment.flap, moves.hinge_rad)))
        return found

    def _fixed(self) -> list[bool]:
        names = [part.name for part in self.box.parts if part.name not in self.joints and part.corners]
        return [not name.startswith("tuck") for name in names]

    def _least(self, shape: ArmShape, corners: Array) -> float:
        """Only samples whose ball comes near enough to matter are asked of the library."""
        thickness_m = self.box.thickness or 0.0
        near = _ball_distance(shape, corners) < 0.006 + thickness_m
        if not near.any():
            return 1.0
        piece, hull = _solid(shape), board(corners, thickness_m)
        return min(_distance(piece, frame, hull) for frame in shape.frames[near])

    def _to_pushed(self, fingers: list[ArmShape], flap: str, hinge_rad: Array) -> float:
        part, joint = self.box.part(flap), self.joints[flap]
        least = 1.0
        for k in range(0, len(hinge_rad), 5):
            hull = board(turned(part, joint, float(hinge_rad[k])), self.box.thickness or 0.0)
            least = min([least, *(_distance(_solid(finger), finger.frames[k], hull) for finger in fingers)])
        return least

    def _above_support(self, shapes: list[ArmShape]) -> float:
        if self.support_m is None:
            return 1.0
        heights = []
        for shape in shapes:
            z, axes = shape.frames[:, 2, 3] - self.support_m, np.abs(shape.frames[:, 2, :3])
            if shape.is_box:
                heights.append((z - axes @ (np.array(shape.size) / 2)).min())
            else:
                heights.append((z - axes[:, 2] * shape.size[1] / 2 - shape.size[0]).min())
        return float(min(heights))


def _ball_distance(shape: ArmShape, corners: Array) -> Array:
    """From the ball around a shape to the panel's rectangle, (S,); never more than the true distance."""
    x = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    z = np.cross(x, corners[2] - corners[0])
    z /= np.linalg.norm(z)
    axes = np.stack([x, np.cross(z, x), z])
    low, high = (corners @ axes.T).min(0), (corners @ axes.T).max(0)
    centres = shape.frames[:, :3, 3] @ axes.T
    outside = np.maximum(np.maximum(low - centres, centres - high), 0.0)
    return np.linalg.norm(outside, axis=1) - shape.radius_m


def _solid(shape: ArmShape) -> coal.ShapeBase:
    return coal.Box(*shape.size) if shape.is_box else coal.Capsule(*shape.size)


def _distance(piece: coal.ShapeBase, frame: Array, hull: coal.ConvexBase) -> float:
    pose = coal.Transform3s()
    pose.setRotation(frame[:3, :3])
    pose.setTranslation(frame[:3, 3])
    return coal.distance(piece, pose, hull, coal.Transform3s(), coal.DistanceRequest(), coal.DistanceResult())
