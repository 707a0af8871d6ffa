"""Look, plan, close a flap, look again: names of flaps, and what the sensor's frames come to."""

from __future__ import annotations

from itertools import pairwise

import msgspec
import numpy as np
import pytest
from closing.problems import Problem, camera_pose, draw_problem

from boxwright import infer
from boxwright.planning import plan_closing
from boxwright.replanning import TRIES, close_by_looking
from boxwright.simulation.physics import (
    Arm,
    LiveBox,
    PhysicsSettings,
    Session,
    crease_class,
    load_robot,
    modelled_box,
)
from boxwright.types import Cloud, Model

ROBOT = "viper_s850"
NUMBER = 4
"""A cake box of three flaps."""


@pytest.fixture
def problem() -> Problem:
    return draw_problem(NUMBER)


def _live(problem: Problem, base_from_input: np.ndarray, settings: PhysicsSettings | None = None) -> LiveBox:
    arm = Arm(load_robot(ROBOT))
    box = modelled_box(problem.box, problem.model.up, np.eye(4))
    ready = np.radians(arm.robot.ready_deg)
    return LiveBox(Session(box, arm, ready, crease_class("pre_broken"), settings=settings), base_from_input)


def _renumbered(problem: Problem, shift: int) -> Model:
    """The same box with side k called (k - shift) mod 4, and so on."""

    def name(text: str) -> str:
        stem, separator, number = text.partition("_")
        return f"{stem}_{(int(number) - shift) % 4}" if separator else text

    parts = tuple(msgspec.structs.replace(part, name=name(part.name)) for part in problem.box.parts)
    joints = tuple(
        msgspec.structs.replace(joint, name=name(joint.name), parent=name(joint.parent), child=name(joint.child))
        for joint in problem.box.joints
    )
    made = msgspec.structs.replace(problem.box, parts=parts, joints=joints)
    return msgspec.structs.replace(problem.model, objects=(made,))


def test_a_plan_on_another_numbering_closes_the_same_flap(problem: Problem) -> None:
    plan = plan_closing(problem.model, ROBOT, np.eye(4))
    one = plan.order[0]
    tried = 0
    for shift in range(4):
        model = _renumbered(problem, shift)
        called = f"flap_{(int(one[-1]) - shift) % 4}"
        live = _live(problem, np.eye(4))
        live.act(plan_closing(model, ROBOT, np.eye(4), only=(called,)), model)
        assert live.pushed == (one,)
        flaps = live.session.verdict("pre_broken", "true").flaps
        assert flaps[one].closed
        assert [name for name, flap in flaps.items() if flap.pushed_to_rad is not None] == [one]
        tried += 1
    assert tried == 4


def test_looking_closes_flap_by_flap_on_models_of_its_own_frames(problem: Problem) -> None:
    base_from_input = camera_pose(problem)
    live = _live(problem, base_from_input)

    def model_of(cloud: Cloud) -> Model:
        return infer(cloud).model

    first = model_of(live.look())
    assert first.objects
    looked = close_by_looking(first, ROBOT, base_from_input, live, model_of)
    assert len(looked.steps) >= 2, looked.ended
    for step in looked.steps:
        assert len(step.plan.order) == 1
        assert step.plan.segments[0].positions[0] == step.plan.segments[-1].positions[-1]
    assert len(looked.steps) <= TRIES * 4
    # Each was planned on what was seen after the one before, but where the box was not seen.
    models = [step.model for step in looked.steps]
    anew = sum(after != before for before, after in pairwise(models))
    assert anew >= len(looked.steps) - 1 - looked.blind
    assert anew >= 1
    flaps = live.session.verdict("pre_broken", "true").flaps
    assert sum(flaps[name].held for name in live.pushed) >= len(live.pushed) - 1


def test_looking_ends_where_the_arm_was_stopped(problem: Problem) -> None:
    """At a limit that any push passes."""
    live = _live(problem, np.eye(4), PhysicsSettings(most_force_n=0.01))

    def never(cloud: Cloud) -> Model:
        raise AssertionError("a stopped arm does not look again")

    looked = close_by_looking(problem.model, ROBOT, np.eye(4), live, never)
    assert len(looked.steps) == 1
    assert live.session.stopped is not None
    assert looked.ended == live.session.stopped.line()


def test_looks_are_the_same_bits_again_and_differ_from_one_another(problem: Problem) -> None:
    one, other = (_live(problem, camera_pose(problem)) for _ in range(2))
    first, again = one.look(), other.look()
    assert np.array_equal(first.points, again.points, equal_nan=True)
    assert not np.array_equal(first.points, one.look().points, equal_nan=True)


def test_where_the_first_sight_lets_nothing_be_planned_it_is_looked_once_more(problem: Problem) -> None:
    """All flaps of the first sight are closed; they are not."""
    flat = tuple(msgspec.structs.replace(joint, position=0.0) for joint in problem.box.joints)
    closed = msgspec.structs.replace(problem.model, objects=(msgspec.structs.replace(problem.box, joints=flat),))
    for sights, steps in (([closed], 0), ([problem.model, closed], 1)):
        left = list(sights)
        live = _live(problem, camera_pose(problem))
        looked = close_by_looking(closed, ROBOT, np.eye(4), live, lambda _, left=left: left.pop(0))
        assert len(looked.steps) == steps
        assert not left, "it looked less often"
