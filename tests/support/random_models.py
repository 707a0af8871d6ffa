"""Random valid box models, and where their panels are at any joint positions, straight from the box's own numbers.

Independent of boxwright.kinematics: a flap at angle a points along cos(a) inward + sin(a) up from its hinge, a tuck at
angle b along cos(b) flap - sin(b) (what the closed flap's upper face looks to). No rotation about a line is composed.
"""

from __future__ import annotations

from dataclasses import dataclass

import msgspec
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from boxwright.types import Inference, Joint, Object, Part, Pose

Matrix = NDArray[np.float64]
Angles = dict[str, float]


@dataclass(frozen=True)
class Flap:
    """A flap on side `side`: width, insets of its free corners at the side's start and end, its tuck's width; m."""

    side: int
    width: float
    taper_start: float
    taper_end: float
    tuck_width: float | None


@dataclass(frozen=True)
class BoxSpec:
    """A box: floor corners in the box frame (4, 2), height, flaps, rotation and position of the box frame."""

    floor: Matrix
    height: float
    flaps: tuple[Flap, ...]
    rotation: Matrix
    position: Matrix
    quaternion: tuple[float, float, float, float]
    base_known: bool
    pose_known: bool
    thickness: float | None


def random_spec(rng: np.random.Generator) -> BoxSpec:
    """A box of 5-60 cm, racked up to 6 degrees, flaps here and there, anywhere within 2 m, turned at will."""
    length, width, height = rng.uniform(0.05, 0.6, 3)
    rack = rng.uniform(-0.1, 0.1)
    x, y = np.array([length / 2, 0.0]), width / 2 * np.array([np.sin(rack), np.cos(rack)])
    flaps = [
        Flap(
            side=k,
            width=float(rng.uniform(0.02, 0.4)),
            taper_start=float(rng.choice([0.0, 0.1 * rng.uniform()])) * min(length, width),
            taper_end=float(rng.choice([0.0, 0.1 * rng.uniform()])) * min(length, width),
            tuck_width=float(rng.uniform(0.01, 0.1)) if rng.uniform() < 0.4 else None,
        )
        for k in range(4)
        if rng.uniform() < 0.85
    ]
    turn = Rotation.random(rng=rng)
    qx, qy, qz, qw = (float(v) for v in turn.as_quat())
    return BoxSpec(
        floor=np.array([-x - y, x - y, x + y, -x + y]),
        height=float(height),
        flaps=tuple(flaps),
        rotation=turn.as_matrix(),
        position=rng.uniform(-2.0, 2.0, 3),
        quaternion=(qx, qy, qz, qw),
        base_known=bool(rng.uniform() < 0.8),
        pose_known=bool(rng.uniform() < 0.8),
        thickness=float(rng.uniform(0.001, 0.007)) if rng.uniform() < 0.7 else None,
    )


def random_angles(spec: BoxSpec, rng: np.random.Generator) -> Angles:
    """Positions (rad) of every hinge within the limits of docs/formats.md, by the name of the part that turns."""
    angles: Angles = {}
    for flap in spec.flaps:
        angles[f"flap_{flap.side}"] = float(rng.uniform(-np.pi / 2, 1.5 * np.pi))
        if flap.tuck_width is not None:
            angles[f"tuck_{flap.side}"] = float(rng.uniform(-np.pi / 2, np.pi))
    return angles


def panels(spec: BoxSpec, angles: Angles) -> dict[str, Matrix]:
    """Corners (4, 3) of every panel in the input's frame at these positions."""
    low = np.column_stack([spec.floor, np.zeros(4)])
    top = low + np.array([0.0, 0.0, spec.height])
    found = {"base": low}
    for k in range(4):
        found[f"side_{k}"] = np.array([top[k], top[(k + 1) % 4], low[(k + 1) % 4], low[k]])
    for flap in spec.flaps:
        found.update(_flap_panels(flap, top[flap.side], top[(flap.side + 1) % 4], angles))
    return {name: corners @ spec.rotation.T + spec.position for name, corners in found.items()}


def random_object(spec: BoxSpec, angles: Angles) -> Object:
    """The model of a box that was measured at these positions, exactly."""
    placed = panels(spec, angles)
    names = ["base"] + [f"{kind}_{k}" for kind in ("side", "flap", "tuck") for k in range(4)]
    missing = {"base"} if not spec.base_known else set()
    return Object(
        template="carton",
        template_probability=None,
        score=1.0,
        probability=None,
        inference=Inference(status="gap", gap=None, alternatives=0),
        dimensions=None,
        outer_dimensions=None,
        thickness=spec.thickness,
        pose=Pose(position=_triple(spec.position), orientation=spec.quaternion) if spec.pose_known else None,
        parameters={},
        parts=tuple(_part(name, None if name in missing else placed.get(name)) for name in names),
        joints=tuple(_joint(name, placed[name], position) for name, position in angles.items()),
    )


def loosened(model_object: Object, rng: np.random.Generator) -> Object:
    """The object with hinges that were measured apart from the panels: moved by centimetres, tilted by degrees."""
    joints = []
    for joint in model_object.joints:
        axis = np.array(joint.axis) + rng.normal(0.0, 0.1, 3)
        joints.append(
            msgspec.structs.replace(
                joint,
                origin=_triple(np.array(joint.origin) + rng.normal(0.0, 0.01, 3)),
                axis=_triple(axis / np.linalg.norm(axis)),
            )
        )
    return msgspec.structs.replace(model_object, joints=tuple(joints))


def _flap_panels(flap: Flap, start: Matrix, end: Matrix, angles: Angles) -> dict[str, Matrix]:
    along = (end - start) / np.linalg.norm(end - start)
    up = np.array([0.0, 0.0, 1.0])
    inward = np.cross(up, along)
    angle = angles[f"flap_{flap.side}"]
    outwards = np.cos(angle) * inward + np.sin(angle) * up
    upper_face = np.cos(angle) * up - np.sin(angle) * inward
    free_end = end + flap.width * outwards - flap.taper_end * along
    free_start = start + flap.width * outwards + flap.taper_start * along
    found = {f"flap_{flap.side}": np.array([start, end, free_end, free_start])}
    if flap.tuck_width is not None:
        tuck_angle = angles[f"tuck_{flap.side}"]
        step = flap.tuck_width * (np.cos(tuck_angle) * outwards - np.sin(tuck_angle) * upper_face)
        found[f"tuck_{flap.side}"] = np.array([free_start, free_end, free_end + step, free_start + step])
    return found


def _part(name: str, corners: Matrix | None) -> Part:
    if corners is None:
        return Part(name=name, observed=False, state=None, corners=None, points=0)
    a, b, c, d = (_triple(corner) for corner in corners)
    return Part(name=name, observed=True, state=None, corners=(a, b, c, d), points=1000)


def _joint(name: str, corners: Matrix, position: float) -> Joint:
    kind, k = name.split("_")
    along = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    tuck = kind == "tuck"
    return Joint(
        name=f"{name}_hinge",
        type="revolute",
        parent=f"flap_{k}" if tuck else f"side_{k}",
        child=name,
        origin=_triple((corners[0] + corners[1]) / 2),
        axis=_triple(-along if tuck else along),
        position=position,
        limits=(-np.pi / 2, np.pi if tuck else 1.5 * np.pi),
        sigma=None,
    )


def _triple(vector: Matrix) -> tuple[float, float, float]:
    return float(vector[0]), float(vector[1]), float(vector[2])
