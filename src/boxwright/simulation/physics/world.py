"""The scene that physics steps through: a box on its support, what stays where it is around it, a tool that pushes.

World frame: the robot's base frame. Gravity acts against the box's `up`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.box_bodies import BoxNames, add_box, contact_of
from boxwright.simulation.physics.creases import Crease
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.things import add_things

Array = NDArray[np.float64]

SUPPORT = "support"
LEVEL_RAD = np.radians(0.1)
"""A base that leans by more stands on a wedge, as on the book that tilts it."""
WEDGE_M = 0.01
"""So thin that under a base that leans by 20 degrees it stands out by less than the clearance of plans."""
FLOOR_RAD = np.radians(1.5)
"""Up to that it is the floor that leans: the wedge goes on beyond the base, for a box that slides."""
FLOOR_MARGIN_M = 0.15


class ToolNames(msgspec.Struct, frozen=True):
    """Of a tool in a scene: its joints in the order of a plan, the bodies that may push, and all of its bodies."""

    joints: tuple[str, ...]
    pushing: tuple[str, ...]
    bodies: tuple[str, ...]


class Tool(Protocol):
    """What pushes flaps: a robot, or in tests a finger on rails."""

    @property
    def name(self) -> str:
        """The robot's name."""
        ...

    def add_to(self, spec: mujoco.MjSpec, settings: PhysicsSettings, start: Array, opening_m: float) -> ToolNames:
        """Puts the tool into a scene, its joints at `start`, its gripper as wide open as told."""
        ...

    def begin(self, model: mujoco.MjModel, data: mujoco.MjData, start: Array, opening_m: float) -> None:
        """Puts the tool's joints at `start`, in a compiled scene."""
        ...

    def commands(self, positions: Array, velocities: Array, accelerations: Array, opening_m: float) -> Array:
        """What its actuators are told (N, actuators) so that its joints follow these (N, J), rad or m, and seconds."""
        ...


class World(msgspec.Struct, frozen=True, eq=False):
    """A compiled scene and the names in it."""

    model: mujoco.MjModel
    box: BoxNames
    tool: ToolNames | None
    settings: PhysicsSettings
    start: tuple[Tool, Array, float] | None
    """The tool, the positions that its joints begin at, and its gripper's opening there."""


def build_world(
    box: BoardBox,
    crease: Crease,
    settings: PhysicsSettings,
    *,
    others: Sequence[BoardBox] = (),
    scene: Sequence[Mapping[str, Any]] = (),
    tool: tuple[Tool, Array, float] | None = None,
    contents_kg: float = 0.0,
) -> World:
    """A scene; `tool` is `World.start`, `scene` what else stands around (things.py)."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    _set_options(spec, box, settings)
    _add_support(spec, box, settings)
    _add_light(spec, box)
    names = add_box(spec, box, crease, settings, contents_kg=contents_kg)
    for k, other in enumerate(others):
        add_box(spec, other, crease, settings, prefix=f"other_{k}_", free=False)
    add_things(spec, scene, settings)
    added = None if tool is None else tool[0].add_to(spec, settings, tool[1], tool[2])
    return World(spec.compile(), names, added, settings, tool)


def _set_options(spec: mujoco.MjSpec, box: BoardBox, settings: PhysicsSettings) -> None:
    option = spec.option
    option.timestep = settings.time_step_s
    option.gravity = -settings.gravity_m_per_s2 * box.up
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    # A sparse Jacobian gives wrong steps in MuJoCo 4.0.0 (google-deepmind/mujoco#3767); these models are small anyway.
    option.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    # Flaps hang on sides that are welded to the box's body, and must touch all of them but their own.
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_FILTERPARENT


def _add_support(spec: mujoco.MjSpec, box: BoardBox, settings: PhysicsSettings) -> None:
    """A level plane under the lowest corner of the base, and a wedge where the base is not level."""
    support = spec.worldbody.add_body(name=SUPPORT)
    frame = box.world_from_box
    under = box.board("base").corners - box.thickness_m / 2.0 * frame[:3, 2]
    lowest = under[np.argmin(under @ box.up)]
    rough = contact_of(settings, settings.friction_support)
    support.add_geom(
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        pos=lowest,
        zaxis=box.up,
        size=[3.0, 3.0, 0.1],
        rgba=(0.55, 0.57, 0.6, 1.0),
        **rough,
    )
    tilt_rad = np.arccos(np.clip(frame[:3, 2] @ box.up, -1.0, 1.0))
    if tilt_rad > LEVEL_RAD:
        margin_m = FLOOR_MARGIN_M if tilt_rad <= FLOOR_RAD else 0.0
        half = np.abs((under - frame[:3, 3]) @ frame[:3, :2]).max(axis=0) + margin_m
        quat = np.zeros(4)
        mujoco.mju_mat2Quat(quat, np.ascontiguousarray(frame[:3, :3]).reshape(9))
        support.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=frame[:3, 3] - WEDGE_M / 2.0 * frame[:3, 2],
            quat=quat,
            size=[*half, WEDGE_M / 2.0],
            rgba=(0.45, 0.25, 0.25, 1.0),
            **rough,
        )


def _add_light(spec: mujoco.MjSpec, box: BoardBox) -> None:
    """For pictures alone."""
    above = box.world_from_box[:3, 3] + 2.5 * box.up
    spec.worldbody.add_light(
        pos=above, dir=-box.up, type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL, diffuse=[0.55, 0.55, 0.55]
    )
    spec.add_texture(
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.85, 0.88, 0.92],
        rgb2=[0.6, 0.65, 0.7],
        width=32,
        height=192,
    )
    spec.visual.headlight.ambient = [0.35, 0.35, 0.35]
    spec.visual.headlight.diffuse = [0.35, 0.35, 0.35]
    spec.visual.headlight.specular = [0.0, 0.0, 0.0]
