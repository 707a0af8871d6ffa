"""From a model to a plan that closes one of its boxes."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

import msgspec
import numpy as np

from boxwright.kinematics.transforms import Matrix, from_pose
from boxwright.planning.asking import ask
from boxwright.planning.checks import refuse_far_base, refuse_poses, warnings_of
from boxwright.planning.measured import measured_box
from boxwright.planning.reach import refuse_out_of_reach, refuse_ready
from boxwright.robots import load_robot
from boxwright.types import Model, Plan, Pose

METHODS = ("layered", "paper")
"""The planners that are built."""

DEFAULT_METHOD = "layered"

Thing = Mapping[str, Any]
"""A box of the scene: name, centre_m (3), rotation (3, 3), size_m (3); metres, base frame."""


def plan_closing(
    model: Model,
    robot: str | PathLike[str],
    base_from_input: Pose | Matrix,
    *,
    object_index: int = 0,
    scene: tuple[Thing, ...] = (),
    method: str = DEFAULT_METHOD,
    only: Sequence[str] = (),
    closed: Sequence[str] = (),
    settings: Mapping[str, Any] | None = None,
) -> Plan:
    """Plan the arm's motions that close the flaps of one object, from the arm's ready pose and back.

    `robot` is a shipped robot's name or a robot's file; `base_from_input` a pose or a (4, 4) transform in metres;
    `scene` what else stands around; where `only` names flaps, all others stay as they are; `closed` flaps were closed
    since the model was seen; `settings` are the core's planning settings by name. The same input gives the same motion
    bit for bit; `seconds` differ.

    Raises ValueError in one line for a robot, object or pose that cannot be used, OSError for files.
    """
    started = time.perf_counter()
    if method not in METHODS:
        raise ValueError(f"method is {method!r}; known are {', '.join(METHODS)}")
    transform = from_pose(base_from_input) if isinstance(base_from_input, Pose) else np.asarray(base_from_input, float)
    refuse_far_base(transform)
    arm = load_robot(robot)
    refuse_ready(arm, str(robot))
    box = measured_box(model, object_index, transform)
    chosen = model.objects[object_index]
    refuse_poses(model, chosen, transform)
    refuse_out_of_reach(arm, chosen, transform)
    answer = ask(robot, box, settings, scene=scene, method=method, only=only, closed=closed)
    fields = {
        "format": "boxwright.plan",
        "version": 1,
        "robot": answer["robot"],
        "base_from_input": transform.tolist(),
        "joint_names": answer["joint_names"],
        "order": answer["order"],
        "flaps": {flap.pop("name"): flap for flap in answer["flaps"]},
        "segments": answer["segments"],
        "method": method,
        "object": object_index,
        "warnings": warnings_of(model, chosen, transform),
        "seconds": time.perf_counter() - started,
    }
    return msgspec.convert(fields, Plan)
