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
"""Flaps open beyond where fingers that come flat and deep find room astride them, or the arm can follow at one go."""
ASTRIDE = {3: "flap_2", 30: "flap_3", 47: "flap_0"}
"""Flaps that a way out that leans off the board would leave through the board's edge."""
WAITING = ((1126, 11), "flap_0", ("flap_1", "flap_3"))
"""A box with stiff creases whose first flap closes only if the box may slide, and keeps two others open till then."""
LEANING_IN = {17: "flap_2", 29: "flap_0"}
"""Flaps of flat boxes of seed 1137, about level and near the support: no room for a gripper in their plane."""
SHALLOW = {41: "flap_3"}
"""One beside whose side, and a neighbour, only the tips of the fingers find room."""

FLAT_IN = {"fork": {"lean_in": 0.0}}
DEEP = {"fork": {"shallow": 0.0}}
FLAT_AND_DEEP = {"lean_in": 0.0, "shallow": 0.0}
HOLD_STILL = {"slides_home_rad": 0.0}


def _plan(number: int, settings: dict[str, Any] | None = None) -> Plan:
    return plan_closing(draw_problem(number).model, ROBOT, np.eye(4), settings=settings)


def test_a_flap_is_turned_in_stages_where_one_does_not_do_and_physics_holds_it() -> None:
    counted = 0
    for number, name in IN_STAGES.items():
        plan = _plan(number, {"fork": FLAT_AND_DEEP})
        pushes = [segment for segment in plan.segments if segment.kind == "push" and segment.flap == name]
        assert len(pushes) == 3, f"problem {number}: {name}"
        at_one_go = _plan(number, {"fork": {**FLAT_AND_DEEP, "most_stages": 1}})
        assert at_one_go.flaps[name].status == "blocked"
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


def test_fingers_lean_as_they_come_or_reach_less_far_in_where_there_is_no_room_and_physics_holds_the_flap() -> None:
    counted = 0
    for found, without in ((LEANING_IN, FLAT_IN), (SHALLOW, DEEP)):
        for number, name in found.items():
            model = draw_problem(number, 1137).model
            plan, none = (
                plan_closing(model, ROBOT, np.eye(4), settings={**told("ordinary"), **more}) for more in ({}, without)
            )
            assert none.flaps[name].status == "blocked", f"problem {number}: {name}"
            assert simulate(plan, model, crease="ordinary").simulation.flaps[name].held, f"problem {number}: {name}"
            counted += 1
    assert counted == 3


def test_what_waited_for_a_flap_that_may_slide_the_box_is_closed_after_it() -> None:
    (seed, number), sliding, waiting = WAITING
    model = draw_problem(number, seed).model
    plan, still = (
        plan_closing(model, ROBOT, np.eye(4), settings={**told("stiff"), **more}) for more in ({}, HOLD_STILL)
    )
    assert all(plan.order.index(sliding) < plan.order.index(name) for name in waiting)
    assert {still.flaps[name].status for name in (sliding, *waiting)} == {"blocked"}
