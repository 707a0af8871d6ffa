"""Lids that their creases do not bear: let down between the fingers, they do not slam into what lies below."""

from __future__ import annotations

from typing import Any

import numpy as np
from closing.creases import told
from closing.problems import draw_problem

from boxwright.planning import plan_closing
from boxwright.simulation.physics import simulate
from boxwright.types import Plan

ROBOT = "viper_s850"
CREASE = "pre_broken"
SLAMMING = ((1140, 94, "flap_0"), (1142, 113, "flap_3"), (1141, 41, "flap_0"))
"""By seed, number and name: large lids that sink into flaps, rims or a base where they fall on them."""
LET_FALL = {"fork": {"most_fall_m_per_s": 100.0}}
LOW_RAD = 0.5


def _plan(seed: int, number: int, settings: dict[str, Any]) -> Plan:
    problem = draw_problem(number, seed)
    return plan_closing(problem.model, ROBOT, np.eye(4), settings={**told(CREASE), **settings})


def test_a_lid_that_would_fall_is_let_down_and_the_run_proves_it() -> None:
    counted = 0
    for seed, number, name in SLAMMING:
        model = draw_problem(number, seed).model
        let_down, let_fall = (_plan(seed, number, settings) for settings in ({}, LET_FALL))
        held = [s for s in let_down.segments if s.flap == name and s.kind == "push" and s.gripper_opening_m > 0.0]
        assert len(held) == 1, f"{seed} {number}"
        assert held[0].hinge_angle_rad is not None
        assert held[0].hinge_angle_rad[-1] < LOW_RAD
        slammed, lowered = (simulate(plan, model, crease=CREASE).simulation for plan in (let_fall, let_down))
        assert slammed.failure is not None
        assert "sank" in slammed.failure
        assert lowered.failure is None
        assert lowered.flaps[name].held
        counted += 1
    assert counted == 3


def test_what_its_crease_bears_is_not_let_down() -> None:
    seed, number, name = SLAMMING[0]
    problem = draw_problem(number, seed)
    plan = plan_closing(problem.model, ROBOT, np.eye(4), settings=told("ordinary"))
    pushes = [segment for segment in plan.segments if segment.flap == name and segment.kind == "push"]
    assert [segment.gripper_opening_m for segment in pushes] == [0.0]
