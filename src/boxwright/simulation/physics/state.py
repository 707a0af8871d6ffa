"""A scene's state: made so that nothing moves before the arm does, read in the conventions of docs/formats.md."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.world import World

Array = NDArray[np.float64]

HELD_SHARE = 0.8
"""A flap that stands has a crease that can hold it, with this much of its moment."""


def standing_state(world: World) -> mujoco.MjData:
    """Everything at rest where it was told to be.

    A crease's rest angle is where its spring bears the flap's weight. A flap that stands where its class of creases
    could not hold it has a stiffer one: its moment is raised until HELD_SHARE of it bears the weight, the angle that it
    springs back by stays. This changes the stiffness in the world's model.
    """
    model = world.model
    data = mujoco.MjData(model)
    if world.start is not None:
        tool, start, opening_m = world.start
        tool.begin(model, data, start, opening_m)
    mujoco.mj_forward(model, data)
    for name in world.box.joint_of.values():
        joint = model.joint(name)
        weight_n_m = float(data.qfrc_bias[joint.dofadr[0]])
        needed = abs(weight_n_m) / (HELD_SHARE * float(joint.springyield[0]))
        joint.stiffness[0] = max(float(joint.stiffness[0]), needed)
        rest_rad = data.qpos[joint.qposadr[0]] + weight_n_m / joint.stiffness[0]
        data.plastic[model.jnt_plasticadr[joint.id]] = rest_rad
    return data


def crease_moments_n_m(world: World) -> dict[str, float]:
    """What folds each flap's crease on, for its whole length."""
    joints = {name: world.model.joint(joint) for name, joint in world.box.joint_of.items()}
    return {name: float(joint.stiffness[0] * joint.springyield[0]) for name, joint in joints.items()}


def flap_positions_rad(world: World, data: mujoco.MjData) -> dict[str, float]:
    """The position of every flap and flap on a flap."""
    return {name: float(data.qpos[world.model.joint(joint).qposadr[0]]) for name, joint in world.box.joint_of.items()}


def world_from_body(world: World, data: mujoco.MjData, body: str) -> Array:
    """A body's pose (4, 4)."""
    index = world.model.body(body).id
    pose = np.eye(4)
    pose[:3, :3] = data.xmat[index].reshape(3, 3)
    pose[:3, 3] = data.xpos[index]
    return pose
