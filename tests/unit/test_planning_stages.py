"""Flaps turned in stages, fingers drawn straight off a flap, flaps that waited for one that may slide the box."""

from __future__ import annotations

from typing import Any

import numpy as np
from closing.creases import told
from closing.problems import draw_problem

from boxwright.planning import plan_closing
from boxwright.simulation.physics import simulate
from boxwright.types import Plan

ROBOT = "viper_s850"
IN_STAGES = {12: "flap_3", 18: "flap_2"}
"""Flaps open beyond where fingers find room astride them, or the arm can follow at one go."""
ASTRIDE = {3: "flap_2", 30: "flap_3", 47: "flap_0"}
"""Flaps that a way out that leans off the board would leave through the board's edge."""
WAITING = ((1126, 11), "flap_0", ("flap_1", "flap_3"))
"""A box with stiff creases whose first flap closes only if the box may slide, and keeps two others open till then."""

AT_ONE_GO = {"fork": {"most_stages": 1}}
HOLD_STILL = {"slides_home_rad": 0.0}


def _plan(number: int, settings: dict[str, Any] | None = None) -> Plan:
    return plan_closing(draw_problem(number).model, ROBOT, np.eye(4), settings=settings)


def test_a_flap_is_turned_in_stages_where_one_does_not_do_and_physics_holds_it() -> None:
    counted = 0
    for number, name in IN_STAGES.items():
        plan = _plan(number)
        pushes = [segment for segment in plan.segments if segment.kind == "push" and segment.flap == name]
        assert len(pushes) == 3, f"problem {number}: {name}"
        assert _plan(number, AT_ONE_GO).flaps[name].status == "blocked"
        assert simulate(plan, draw_problem(number).model).simulation.flaps[name].held, f"problem {number}: {name}"
        counted += 1
    assert counted == 2


def test_fingers_come_to_a_flap_and_leave_it_without_catching_on_its_edge() -> None:
    counted = 0
    for number, name in ASTRIDE.items():
        plan = _plan(number)
        assert not any("between two postures" in (flap.reason or "") for flap in plan.flaps.values())
        openings_m = [segment.gripper_opening_m for segment in plan.segments if segment.flap == name]
        assert plan.flaps[name].status == "planned", f"problem {number}: {name}"
        counted += max(openings_m) > 0.0
    assert counted == 3


def test_what_waited_for_a_flap_that_may_slide_the_box_is_closed_after_it() -> None:
    (seed, number), sliding, waiting = WAITING
    model = draw_problem(number, seed).model
    plan, still = (
        plan_closing(model, ROBOT, np.eye(4), settings={**told("stiff"), **more}) for more in ({}, HOLD_STILL)
    )
    assert all(plan.order.index(sliding) < plan.order.index(name) for name in waiting)
    assert {still.flaps[name].status for name in (sliding, *waiting)} == {"blocked"}
