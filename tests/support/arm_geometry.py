"""Where an ortho-parallel arm's shapes are, from its file alone: the tests' own reading of docs/robots.md.

Many samples at once: S samples, (S, 4, 4) frames.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ArmShape:
    """A capsule along z of `size` (radius, length between centres), or a box of `size` (3); frames base_from_shape."""

    body: str
    is_box: bool
    size: tuple[float, ...]
    frames: Array

    @property
    def radius_m(self) -> float:
        """Of the ball around it."""
        return float(np.linalg.norm(self.size) / 2) if self.is_box else self.size[0] + self.size[1] / 2


def arm_shapes(path: Path, positions: Array, opening_m: float) -> list[ArmShape]:
    """The shapes of all bodies but the base at positions (S, 6), rad."""
    robot = tomllib.loads(path.read_text(encoding="utf-8"))
    frames = _frames(robot["opw"], positions)
    shapes = []
    for number, link in enumerate(robot["link"]):
        if number == 0:
            continue
        shapes += [_capsule(link["name"], frames[number], capsule) for capsule in link.get("capsules", [])]
        shapes += [
            ArmShape(link["name"], True, tuple(box["size_m"]), frames[number] @ _shift(box["centre_m"]))
            for box in link.get("boxes", [])
        ]
    gripper, flange = robot["gripper"], frames[7]
    body, finger = gripper["body_size_m"], gripper["finger_size_m"]
    shapes.append(ArmShape("gripper", True, tuple(body), flange @ _shift([0, 0, body[2] / 2])))
    for side in (1, -1):
        centre = [0, side * (opening_m + finger[1]) / 2, body[2] + finger[2] / 2]
        shapes.append(ArmShape("fingers", True, tuple(finger), flange @ _shift(centre)))
    return shapes


def limits(path: Path) -> dict[str, Array]:
    """Positions (J, 2) rad, speeds and accelerations (J,)."""
    joints = tomllib.loads(path.read_text(encoding="utf-8"))["joint"]
    return {
        "positions": np.radians([joint["limits_deg"] for joint in joints]),
        "speeds": np.radians([joint["speed_deg_per_s"] for joint in joints]),
        "accelerations": np.radians([joint["acceleration_deg_per_s2"] for joint in joints]),
    }


def _frames(opw: dict, positions: Array) -> list[Array]:
    """Base, six links, flange: (S, 4, 4) each. At theta = 0 all are parallel to the base (docs/robots.md)."""
    theta = np.array(opw["signs"]) * positions - np.radians(opw["offsets_deg"])
    a1, a2, b, c1, c2, c3, c4 = (opw[f"{name}_m"] for name in ("a1", "a2", "b", "c1", "c2", "c3", "c4"))
    origins = ((0, 0, 0), (a1, 0, c1), (0, 0, c2), (a2, b, 0), (0, 0, c3), (0, 0, 0))
    frames = [np.broadcast_to(np.eye(4), (len(positions), 4, 4))]
    for number, (origin, axis) in enumerate(zip(origins, "zyyzyz", strict=True)):
        frames.append(frames[-1] @ _shift(origin) @ _turn(axis, theta[:, number]))
    return [*frames, frames[-1] @ _shift((0, 0, c4))]


def _shift(offset: object) -> Array:
    frame = np.eye(4)
    frame[:3, 3] = np.asarray(offset, dtype=float)
    return frame


def _turn(axis: str, angles: Array) -> Array:
    frames = np.broadcast_to(np.eye(4), (len(angles), 4, 4)).copy()
    i, j = {"z": (0, 1), "y": (2, 0)}[axis]
    frames[:, i, i] = frames[:, j, j] = np.cos(angles)
    frames[:, j, i], frames[:, i, j] = np.sin(angles), -np.sin(angles)
    return frames


def _capsule(body: str, frames: Array, capsule: dict) -> ArmShape:
    start, end = np.array(capsule["from_m"]), np.array(capsule["to_m"])
    length = float(np.linalg.norm(end - start))
    z = (end - start) / length
    x = np.cross(z, [1.0, 0.0, 0.0] if abs(z[0]) < 0.9 else [0.0, 1.0, 0.0])
    x /= np.linalg.norm(x)
    local = np.eye(4)
    local[:3, :3] = np.column_stack([x, np.cross(z, x), z])
    local[:3, 3] = (start + end) / 2
    return ArmShape(body, False, (capsule["radius_m"], length), frames @ local)
