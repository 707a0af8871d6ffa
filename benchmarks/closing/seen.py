"""A problem through the simulated sensor: the model is inferred from a frame, and physics closes the true box."""

from __future__ import annotations

from typing import Any

import msgspec
import numpy as np
from benchmarks.closing.problems import Problem, camera_pose

from boxwright import infer
from boxwright.planning import plan_closing
from boxwright.replanning import close_by_looking
from boxwright.simulation.physics import BoardBox, LiveBox, cloud_of, modelled_box, run_of, staged_plan
from boxwright.simulation.physics.look import look_again
from boxwright.simulation.poses import inverse
from boxwright.types import Cloud, Model, Simulation

SAME_BOX_M = 0.2


class Seen(msgspec.Struct, frozen=True, eq=False):
    """The true box, its flaps named as the statuses name them, with the reasons of what is not planned; what physics
    says of it, if it ran."""

    box: BoardBox
    statuses: dict[str, str]
    reasons: dict[str, str | None]
    planning_s: float
    simulation: Simulation | None


def close_seen(problem: Problem, robot: str, crease: str, settings: dict[str, Any], *, again: bool) -> Seen:
    """Sees the box, plans and closes it at one go, or looks `again` after each flap."""
    box = modelled_box(problem.box, problem.model.up, np.eye(4))
    base_from_input = camera_pose(problem)
    frame = look_again([box], base_from_input, problem.number)
    model = _inferred(cloud_of(frame))
    index = _nearest(model, base_from_input, box)
    if index is None:
        return Seen(box, {}, {}, 0.0, None)
    plan = plan_closing(model, robot, base_from_input, object_index=index, settings=settings)
    statuses = {name: flap.status for name, flap in plan.flaps.items()}
    reasons = {name: flap.reason for name, flap in plan.flaps.items()}
    if not plan.segments:
        return Seen(_numbered_alike(box, model, index, base_from_input), statuses, reasons, plan.seconds, None)
    staged = staged_plan(plan, model, frame.truth, crease=crease)
    if not again:
        staged.session.follow(plan.segments)
    else:
        live = LiveBox(staged.session, base_from_input, staged.others, seed=1000 * (problem.number + 1))
        close_by_looking(model, robot, base_from_input, live, _inferred, object_index=index, settings=settings)
        statuses |= dict.fromkeys(live.pushed, "planned")
        reasons |= dict.fromkeys(live.pushed)
    simulation = run_of(staged.session, crease, staged.kind).simulation
    return Seen(staged.session.box, statuses, reasons, plan.seconds, simulation)


def _inferred(cloud: Cloud) -> Model:
    return infer(cloud).model


def _nearest(model: Model, base_from_input: np.ndarray, box: BoardBox) -> int | None:
    """The object whose base is where the box's is."""
    where = inverse(base_from_input) @ box.world_from_box
    far_m = {
        k: float(np.linalg.norm(np.array(found.pose.position) - where[:3, 3]))
        for k, found in enumerate(model.objects)
        if found.pose is not None and found.joints
    }
    nearest = min(far_m, key=far_m.__getitem__, default=None)
    return nearest if nearest is not None and far_m[nearest] <= SAME_BOX_M else None


def _numbered_alike(box: BoardBox, model: Model, index: int, base_from_input: np.ndarray) -> BoardBox:
    from boxwright.simulation.physics.matching import matched

    return matched([box], modelled_box(model.objects[index], model.up, base_from_input))[1]
