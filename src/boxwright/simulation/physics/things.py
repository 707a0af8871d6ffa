"""What else stands around, as bodies that do not move: boxes told in the robot's base frame, as planning takes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
import mujoco
import numpy as np

from boxwright.simulation.physics.box_bodies import SOLID, contact_of
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.types.checks import require_positive, require_rigid
from boxwright.types.truth import Vector

PREFIX = "scene_"
"""Told apart by it from what else a scene has: a thing may be called as a flap is."""
THING_RGBA = (0.45, 0.55, 0.5, 1.0)
NUMBERS = ("centre_m", "rotation", "size_m")
ROUNDED = 1e-4
"""Rotations may be typed by hand."""


class Thing(msgspec.Struct, frozen=True):
    """A cuboid: its name, centre and edges (m), and its axes as the columns of a rotation; the robot's base frame.

    Things of one name are one body.
    """

    name: str
    centre_m: Vector
    rotation: tuple[Vector, Vector, Vector]
    size_m: Vector

    def __post_init__(self) -> None:
        require_positive("size_m", self.size_m)
        require_rigid("rotation", self._pose(), ROUNDED)

    def _pose(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = self.rotation, self.centre_m
        return pose

    def add_to(self, body: mujoco.MjsBody, settings: PhysicsSettings) -> None:
        """Puts it into a body that stands in the world's frame."""
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, np.array(self.rotation).reshape(9))
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=self.centre_m,
            quat=quat,
            size=np.array(self.size_m) / 2.0,
            rgba=THING_RGBA,
            **SOLID.as_geom(),
            **contact_of(settings, settings.friction_board),
        )


def add_things(spec: mujoco.MjSpec, things: Sequence[Mapping[str, Any]], settings: PhysicsSettings) -> None:
    """A fixed body for each name; raises ValueError naming the thing and the key that does not fit."""
    bodies: dict[str, mujoco.MjsBody] = {}
    for told in things:
        try:
            # Numbers may be numpy's, as planning takes them.
            numbers = {key: np.asarray(told[key], float).tolist() for key in NUMBERS if key in told}
            thing = msgspec.convert({**told, **numbers}, Thing)
        except (TypeError, ValueError) as error:
            raise ValueError(f"scene: {told.get('name', 'a thing')}: {error}") from error
        if thing.name not in bodies:
            bodies[thing.name] = spec.worldbody.add_body(name=f"{PREFIX}{thing.name}")
        thing.add_to(bodies[thing.name], settings)
