"""A plan against the box that it was made for, or against the one that is really there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.arm import Arm
from boxwright.simulation.physics.boards import BoardBox, modelled_box, true_box
from boxwright.simulation.physics.creases import crease_class
from boxwright.simulation.physics.matching import matched
from boxwright.simulation.physics.robot_file import load_robot
from boxwright.simulation.physics.run import CREASE, Run, run_of
from boxwright.simulation.physics.session import Load, Session
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.types import Model, Plan, RobotFile, Truth
from boxwright.types.checks import require_positive

Array = NDArray[np.float64]

THICKEST_M = 0.05
"""Three times the thickest cardboard there is; what is thicker has no creases."""


def simulate(
    plan: Plan,
    model: Model,
    truth: Truth | None = None,
    *,
    crease: str = CREASE,
    crease_file: str | PathLike[str] | None = None,
    robot: RobotFile | str | PathLike[str] | None = None,
    load: Load | None = None,
    settings: PhysicsSettings | None = None,
    thickness_m: float | None = None,
    scene: Sequence[Mapping[str, Any]] = (),
    stills_per_s: float = 0.0,
) -> Run:
    """Follow a plan in physics, against the true box where a truth is given, else against the planned-on model.

    The true box is the one that stands where the planned object was thought to stand, its flaps named as the model
    names them. The frame's other boxes, true or inferred, stand where they are and do not move. `robot` is the
    plan's, or its name or TOML file; `thickness_m` goes before what truth or model tell of the board; `scene` is
    what else stands around and does not move, as `plan_closing` takes it.

    Raises ValueError when plan, model and truth do not belong together, or a value cannot be used; OSError for files.
    """
    require_motion(plan)
    staged = staged_plan(
        plan, model, truth, crease=crease, crease_file=crease_file, robot=robot, load=load, settings=settings,
        thickness_m=thickness_m, scene=scene, stills_per_s=stills_per_s,
    )  # fmt: skip
    staged.session.follow(plan.segments)
    return run_of(staged.session, crease, staged.kind)


class Staged(msgspec.Struct, frozen=True, eq=False):
    """A box before the arm that is to follow a plan, the boxes beside it, and whether it is the true one."""

    session: Session
    others: tuple[BoardBox, ...]
    kind: Literal["inferred", "true"]


def staged_plan(
    plan: Plan,
    model: Model,
    truth: Truth | None = None,
    *,
    crease: str = CREASE,
    crease_file: str | PathLike[str] | None = None,
    robot: RobotFile | str | PathLike[str] | None = None,
    load: Load | None = None,
    settings: PhysicsSettings | None = None,
    thickness_m: float | None = None,
    scene: Sequence[Mapping[str, Any]] = (),
    stills_per_s: float = 0.0,
) -> Staged:
    """All that `simulate` needs, at rest before the plan's first posture; arguments and errors are those of it.

    Before a plan without a motion the arm waits in its ready pose, for plans that are made later.
    """
    base_from_input = np.array(plan.base_from_input)
    box, others = scene_boxes(plan, model, truth, base_from_input, thickness_m)
    arm = Arm(robot if isinstance(robot, RobotFile) else load_robot(robot or plan.robot))
    if arm.name != plan.robot:
        raise ValueError(f"the plan is for robot {plan.robot!r}; the one given is {arm.name!r}")
    names = tuple(joint.name for joint in arm.robot.joint)
    if names != plan.joint_names:
        raise ValueError(
            f"the plan's joints are {', '.join(plan.joint_names)}; those of {arm.name}: {', '.join(names)}"
        )
    session = Session(
        box,
        arm,
        np.array(plan.segments[0].positions[0]) if plan.segments else np.radians(arm.robot.ready_deg),
        crease_class(crease, crease_file),
        opening_m=plan.segments[0].gripper_opening_m if plan.segments else 0.0,
        settings=settings,
        load=load,
        others=others,
        scene=scene,
        stills_per_s=stills_per_s,
    )
    return Staged(session, tuple(others), "inferred" if truth is None else "true")


def require_motion(plan: Plan) -> None:
    """Raises ValueError where a plan has nothing that could be followed."""
    if not plan.segments:
        raise ValueError("there is no segment to follow; a plan that closes no flap has no motion")


def scene_boxes(
    plan: Plan, model: Model, truth: Truth | None, base_from_input: Array, thickness_m: float | None
) -> tuple[BoardBox, Sequence[BoardBox]]:
    """The box to close, and the others of the scene, in the robot's base frame; errors as `simulate`."""
    if not 0 <= plan.object < len(model.objects):
        raise ValueError(f"the plan is for object {plan.object}; the model has {len(model.objects)}, counted from 0")
    _refuse_thickness(thickness_m)
    modelled = modelled_box(model.objects[plan.object], model.up, base_from_input, thickness_m)
    if truth is None:
        rest = [found for k, found in enumerate(model.objects) if k != plan.object and found.pose is not None]
        return modelled, [modelled_box(found, model.up, base_from_input, thickness_m) for found in rest]
    true_boxes = [true_box(truth, k, base_from_input, thickness_m) for k in range(len(truth.boxes))]
    index, box = matched(true_boxes, modelled)
    return box, [other for k, other in enumerate(true_boxes) if k != index]


def _refuse_thickness(thickness_m: float | None) -> None:
    if thickness_m is None:
        return
    require_positive("thickness_m", [min(thickness_m, THICKEST_M)])
    if thickness_m > THICKEST_M:
        raise ValueError(f"board is told to be {1e3 * thickness_m:g} mm thick; it is {1e3 * THICKEST_M:g} at most")
