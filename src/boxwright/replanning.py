"""Look, plan, close one flap, look again: a box that slid, or a flap that sprang open, is seen and planned for anew."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from os import PathLike
from typing import Any, Protocol

import msgspec
import numpy as np

from boxwright.kinematics.transforms import Matrix, apply
from boxwright.planning import measured_box, plan_closing
from boxwright.types import Cloud, Joint, Model, Object, Plan

TRIES = 2
"""How often a flap is pushed that is seen to stand open again."""
SAME_HINGE_M = 0.08
"""Hinges whose middles are no farther apart, from one look to the next, are one and the same."""
SAME_BOX_M = 0.2
"""The same of boxes and their bases."""
SAME_SIZE_M = 0.01
SAME_SIZE_SHARE = 0.04
"""Dimensions that differ by more than this are another box's, or were not seen well."""


class Place(Protocol):
    """Where a box stands before an arm: real, or simulated."""

    def look(self) -> Cloud:
        """What the sensor sees now, in the same input frame each time."""
        ...

    def act(self, plan: Plan, model: Model) -> str | None:
        """Lets the arm follow a plan that was made on that model; why it was stopped, None where it was not."""
        ...


class Step(msgspec.Struct, frozen=True, eq=False):
    """One flap's plan, and the model that it was made on."""

    model: Model
    plan: Plan


class Looked(msgspec.Struct, frozen=True, eq=False):
    """The steps, how many of the looks between them did not show the box, and why there is no further step."""

    steps: tuple[Step, ...]
    blind: int
    ended: str


class _Sight(msgspec.Struct, frozen=True, eq=False):
    """The last model in which the box was seen, which object it is, and the flaps that were closed since."""

    model: Model
    index: int
    closed: tuple[str, ...] = ()

    @property
    def box(self) -> Object:
        return self.model.objects[self.index]


class _Tries:
    """Mutable: which hinges were pushed about how often, by the places of their middles in the base frame."""

    def __init__(self, base_from_input: Matrix) -> None:
        self._base_from_input = base_from_input
        self._places: list[tuple[Matrix, int]] = []

    def count(self, joint: Joint) -> int:
        """How often this hinge was pushed about until now."""
        return self._found(joint)[1]

    def note(self, joint: Joint) -> None:
        """It is pushed once more."""
        at, count = self._found(joint)
        if at >= 0:
            self._places[at] = (self._place(joint), count + 1)
        else:
            self._places.append((self._place(joint), 1))

    def _found(self, joint: Joint) -> tuple[int, int]:
        place = self._place(joint)
        far_m = [float(np.linalg.norm(place - known)) for known, _ in self._places]
        nearest = int(np.argmin(far_m)) if far_m else -1
        return (nearest, self._places[nearest][1]) if far_m and far_m[nearest] <= SAME_HINGE_M else (-1, 0)

    def _place(self, joint: Joint) -> Matrix:
        (place,) = apply(self._base_from_input, np.array([joint.origin]))
        return np.asarray(place)


def close_by_looking(
    first: Model,
    robot: str | PathLike[str],
    base_from_input: Matrix,
    place: Place,
    infer: Callable[[Cloud], Model],
    *,
    object_index: int = 0,
    **planning: Any,
) -> Looked:
    """Close a box flap by flap, each planned on what is seen after the one before; `first` is the first sight of it.

    Where a look does not show the box, or shows one of another size in its place, what was seen before counts on, with
    the flaps that were closed since. `planning` goes to `plan_closing`. Ends when nothing is left to plan, or each flap
    left was tried `TRIES` times; where the first sight lets nothing be planned it is looked once more before that.
    Raises as `plan_closing` does on the first model.
    """
    measured_box(first, object_index, base_from_input)
    tries = _Tries(base_from_input)
    sight, blind, has_looked = _Sight(first, object_index), 0, False
    steps: list[Step] = []
    while True:
        plan = _next_flap(sight, robot, base_from_input, tries, planning)
        if plan is None and has_looked:
            return Looked(tuple(steps), blind, "nothing is left that can be planned")
        if plan is not None:
            stopped = place.act(plan, sight.model)
            steps.append(Step(sight.model, plan))
            if stopped is not None:
                return Looked(tuple(steps), blind, stopped)
            if plan.segments[-1].positions[-1] != plan.segments[0].positions[0]:
                return Looked(tuple(steps), blind, "the arm found no way back to where it looks from")
        seen, has_looked = infer(place.look()), True
        found = _same_box(seen, sight.box)
        if found is not None:
            sight = _Sight(seen, found)
        else:
            since = () if plan is None else plan.order
            sight, blind = _Sight(sight.model, sight.index, (*sight.closed, *since)), blind + 1


def _next_flap(
    sight: _Sight, robot: str | PathLike[str], base_from_input: Matrix, tries: _Tries, planning: Mapping[str, Any]
) -> Plan | None:
    """The plan of the flap that comes next, alone; None where no flap is left, or none of them can be planned."""
    joints = {joint.child: joint for joint in sight.box.joints}
    wanted = tuple(name for name, joint in joints.items() if name not in sight.closed and tries.count(joint) < TRIES)
    if not wanted:
        return None
    known = {"object_index": sight.index, "closed": sight.closed, **planning}
    whole = plan_closing(sight.model, robot, base_from_input, only=wanted, **known)
    for name in whole.order[:1]:
        tries.note(joints[name])
        alone = plan_closing(sight.model, robot, base_from_input, only=(name,), **known)
        return alone if alone.segments else None
    return None


def _same_box(model: Model, known: Object) -> int | None:
    """The object that stands where the known one did, and is as large; both in the input's frame."""
    if known.pose is None:
        return None
    far_m = {
        k: float(np.linalg.norm(np.subtract(found.pose.position, known.pose.position)))
        for k, found in enumerate(model.objects)
        if found.pose is not None and found.joints and _as_large(found, known)
    }
    nearest = min(far_m, key=far_m.__getitem__, default=None)
    return nearest if nearest is not None and far_m[nearest] <= SAME_BOX_M else None


def _as_large(found: Object, known: Object) -> bool:
    """Length and width may have changed places, as sides are numbered from the camera."""
    if found.dimensions is None or known.dimensions is None:
        return False
    sizes, others = ((*sorted(o.dimensions[:2]), o.dimensions[2]) for o in (found, known) if o.dimensions)
    return all(abs(a - b) <= SAME_SIZE_M + SAME_SIZE_SHARE * b for a, b in zip(sizes, others, strict=True))
