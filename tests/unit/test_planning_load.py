"""How hard a box may be pushed: what statics refuse, physics cannot close; what is told of the box changes it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from closing.creases import told as told_of
from closing.problems import Problem, draw_problem

from boxwright.planning import ask_bearable, assumed, measured_box, plan_closing
from boxwright.simulation.physics import crease_class, simulate
from boxwright.types import Plan

ROBOT = "viper_s850"
LIGHT = (18, 156)
"""Small boxes with short flaps that the arm reaches and that take more than holds the box."""
SLIDING = ((1134, 54), (1134, 96), (1134, 107))
"""By seed and number: boxes that slide far, and whose flaps stay open, where they are pushed regardless."""
SMALL = 0
"""One none of whose flaps can be pushed where it weighs 0.2 kg."""

FALLING = (1136, 22, "flap_1")
"""A lid by itself, heavier than a pre-broken crease of its length bears."""
DRAGGED = (1136, 144)
"""A small box that slid where a finger on a flap's edge dragged it the way that its side leant."""

IN_THE_WAY = ((1140, 114, "ordinary", "flap_1", "the support"), (1143, 239, "pre_broken", "flap_1", "side_1"))
"""Flaps that hang low, which a push at their edges would turn: what is named last leaves the fingers no room there."""

NO_FORK = {"fork": {"most_depth_m": 0.0}}
REGARDLESS = {"most_strain": 1e9, **NO_FORK}


def _plan(problem: Problem, settings: dict[str, Any] | None = None) -> Plan:
    return plan_closing(problem.model, ROBOT, np.eye(4), settings=settings)


def test_a_flap_that_would_move_the_box_is_told_and_physics_agrees() -> None:
    counted = 0
    for seed, number in SLIDING:
        problem = draw_problem(number, seed)
        plan, regardless = _plan(problem, NO_FORK), _plan(problem, REGARDLESS)
        refused = [name for name, flap in plan.flaps.items() if flap.reason and "slide or tip" in flap.reason]
        assert all(plan.flaps[name].status == "blocked" for name in refused)
        careful, careless = (simulate(made, problem.model).simulation for made in (plan, regardless))
        assert all(careful.flaps[name].held for name in plan.order)
        assert careful.box_slid_m < 0.005 < 0.02 < careless.box_slid_m
        for name in refused:
            if name in regardless.order:
                assert not careless.flaps[name].held, f"problem {number}: {name}"
                counted += 1
    assert counted >= 3


def test_what_stands_in_the_way_is_told_where_the_box_would_bear_a_push() -> None:
    for seed, number, crease, name, obstacle in IN_THE_WAY:
        problem = draw_problem(number, seed)
        assert ask_bearable(measured_box(problem.model, 0, np.eye(4)), told_of(crease))[name]
        flap = _plan(problem, told_of(crease)).flaps[name]
        assert flap.status == "blocked"
        assert f"fingers come too near to {obstacle}" in (flap.reason or "")


def test_a_couple_turns_what_a_push_would_move_the_box_for() -> None:
    counted = 0
    for number in LIGHT:
        problem = draw_problem(number)
        without, plan = _plan(problem, NO_FORK), _plan(problem)
        pushes = [segment for segment in plan.segments if segment.kind == "push"]
        forked = {segment.flap for segment in pushes if segment.gripper_opening_m > 0.0 and segment.flap is not None}
        run = simulate(plan, problem.model).simulation
        for name in sorted(forked):
            assert run.flaps[name].held, f"problem {number}: {name}"
            counted += without.flaps[name].status == "blocked"
        assert run.box_slid_m < 0.015, f"problem {number}"
        assert not run.unwanted
    assert counted == 5


def test_a_heavy_box_bears_what_a_light_one_does_not() -> None:
    problem = draw_problem(SMALL)
    box = measured_box(problem.model, 0, np.eye(4))
    figures = crease_class("ordinary")
    told: dict[str, Any] = {
        "moment_n_m_per_m": figures.moment_n_m_per_m,
        "board_m": figures.board_mm / 1000.0,
        "return_rad": figures.return_rad,
    }
    light, heavy = (ask_bearable(box, assumed(**told, mass_kg=mass_kg)) for mass_kg in (0.2, 20.0))
    assert light.keys() == heavy.keys()
    assert not any(light.values())
    assert all(heavy.values())
    assert len(heavy) >= 3


def test_what_creases_give_back_is_pushed_beyond_closed() -> None:
    problem = draw_problem(3)
    counted = 0
    for name in ("pre_broken", "ordinary", "stiff"):
        figures = crease_class(name)
        settings = assumed(
            moment_n_m_per_m=figures.moment_n_m_per_m,
            board_m=figures.board_mm / 1000.0,
            return_rad=figures.return_rad,
            mass_kg=20.0,
        )
        plan = _plan(problem, settings)
        first = next(segment for segment in plan.segments if segment.kind == "push")
        assert first.flap is not None
        assert first.hinge_angle_rad is not None
        rest_rad = plan.flaps[first.flap].rest_rad
        assert rest_rad is not None
        # It comes back by no more than the class says, and by less where its weight holds it down.
        assert 0.0 <= rest_rad - first.hinge_angle_rad[-1] <= figures.return_rad + 1e-9
        counted += 1
    assert counted == 3


def test_a_lid_that_would_fall_into_its_box_is_left_open() -> None:
    seed, number, name = FALLING
    problem = draw_problem(number, seed)
    light, firm = (_plan(problem, told_of(crease)) for crease in ("pre_broken", "ordinary"))
    assert (light.flaps[name].status, light.order) == ("blocked", ())
    assert "would fall into the box" in (light.flaps[name].reason or "")
    assert firm.flaps[name].status == "planned"
    assert simulate(firm, problem.model, crease="ordinary").simulation.flaps[name].held


def test_fingers_on_edges_are_held_so_that_their_drag_leaves_the_box() -> None:
    seed, number = DRAGGED
    problem = draw_problem(number, seed)
    plan = _plan(problem, told_of("ordinary"))
    run = simulate(plan, problem.model, crease="ordinary").simulation
    assert len(plan.order) == 4
    assert all(run.flaps[name].held for name in plan.order)
    assert run.box_slid_m < 0.005


def test_figures_that_are_none_are_refused() -> None:
    with pytest.raises(ValueError, match="return_rad"):
        assumed(moment_n_m_per_m=0.6, board_m=0.004, return_rad=-0.1)
