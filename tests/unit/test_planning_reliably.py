"""Flaps that other flaps, their own ends or the way to them kept open: what closes them now, in physics."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from closing.creases import told
from closing.problems import draw_problem

from boxwright.planning import plan_closing
from boxwright.simulation.physics import simulate
from boxwright.types import Plan
from support.dense_check import Clearances
from support.repository import PACKAGE

ROBOT = "viper_s850"
ROBOT_FILE = PACKAGE / "robots" / "data" / f"{ROBOT}.toml"
CLEARANCE_M = 0.005
ROUNDING_M = 1e-6
OVER_THE_RIM = (1128, 45)
"""A box out of square: flaps reach over the rim's corners, and pass their neighbours only where ends give way."""
OVER_OTHERS = (1142, 228, "flap_1")
"""A flap over others so short that fingers on it, closed, would be too near to them."""
ON_STACKS = {(2013, 0): "flap_2"}
"""A flap that comes to lie on others that overlap, and springs back beyond what counts as closed by itself."""
IN_TWO = (2011, 125, "flap_1")
"""A flap that no push from the start takes to closed and beyond."""

SQUARELY = ((1133, 58, "ordinary"), (1133, 66, "pre_broken"))
"""Boxes of which a finger slipped off a flap's edge that it pressed aslant."""
BY_THE_BASE = (1133, 86, "flap_3")
"""A flap that would swing into the arm's base."""
PRESSED_DOWN = (1133, 7)
"""Four long flaps of which each lies on others that spring up; those near its hinge are pressed down easily."""
ON_RIMS = (1135, 8)
"""Four flaps; two lie on one another and on the rims: the others come to lie on their corners, and no press helps."""
SPRINGS_UP = (1144, 151, "flap_1")
"""A flap that those across from one another prop up so far that its crease lifts it off them."""
LEFT = (1142, 44, "flap_2")
"""A flap that after all others the last searches find how to push."""
BY_THE_TIP = (1134, 68, "flap_3")
"""One that is held with the very tip alone, or near its hinge."""
JAMMING = ((1142, 218), (1141, 110))
"""Boxes out of square: a flap came down steeply on the free edge of one that sprang up, and the arm dragged them."""
GOES_WRONG = (1144, 264, "flap_2")
"""A light box that the couple on one flap drags: closed first it stops the arm, and two more flaps stay open."""
STEEPLY = (1144, 194, ("flap_0", "flap_2", "flap_3"))
"""A box and the order that presses no end down steeply: the other drags it by 292 mm."""
STEEPLY_AT_LAST = (1144, 38, "flap_1")
"""One that presses an end down steeply whatever the order: before the others it drags the box by 17 mm."""
ON_A_LID = (1142, 70, ("flap_1", "flap_3"))
"""Short flaps over the corners of a lid that lies lower than it is told."""
ON_THE_BASE = (1142, 113, "flap_3")
"""A flap of a flat box that meets its base before it is as far beyond closed as its crease gives back."""
ASLANT = (1143, 86, "flap_2")
"""A flap far from the arm whose edge alone is in reach, with the finger aslant on it."""
HEAVY = (1145, 286, "flap_3")
"""A lid that its weight keeps down: pushed 9 degrees beyond closed, it fell into the box."""
SPRINGS_OFF = (1145, 145, "flap_3")
"""A flap pushed only as far as the stack below is told to let it, which sprang off that beyond closed."""
FAR_OFF = (1133, 7, "flap_3")
"""A flap that no posture reaches once its box stands 0.4 m further away: what is near the hand is no reason."""
NEAR_THE_SUPPORT = (1143, 59, "flap_1")
"""A flap of a flat box: a finger has room below it between the wide search's contacts alone."""
STRANDED = {7: 2, 12: 1, 13: 2, 25: 1}
"""By number: boxes of seed 2013, and to how many flaps an arm that knows straight lines alone finds no way."""

STRAIGHT_ALONE = {"transit_tries": 0, "shortcuts": 0}
# Not near its hinge, nor with the very tip.
FIRMLY: dict[str, Any] = {"fine_contacts": {"least_lever": 0.2, "least_hook_m": 0.006, "most_lean": 0.95}}
USUAL = {"beams": [16, 50]}
ONE_SEARCH = {"beams": [16]}
SQUARE = {"slanting_square": 0.6}
WIDE_APART = {"finest_step_m": 0.02, "most_finest_contacts": [13, 9]}
PUSHED_HOME = {"least_lay_rad": 9.0}
AT_ONE_GO = {"fork": {"most_stages": 1}}
GENTLE_N = 60.0
"""No push of a flap that goes where it should takes more."""


def _plan(seed: int, number: int, crease: str, settings: dict[str, Any] | None = None) -> Plan:
    return plan_closing(
        draw_problem(number, seed).model, ROBOT, np.eye(4), settings={**told(crease), **(settings or {})}
    )


def _all_held(seed: int, number: int, crease: str, plan: Plan) -> bool:
    run = simulate(plan, draw_problem(number, seed).model, crease=crease).simulation
    return run.failure is None and not run.unwanted and all(run.flaps[name].held for name in plan.order)


def _keeps_clear(seed: int, number: int, plan: Plan) -> bool:
    """Every millisecond, by another collision library."""
    found = Clearances(draw_problem(number, seed).model, ROBOT_FILE).of_plan(plan)
    return all(least_m >= (0.0 if what == "finger" else CLEARANCE_M) - ROUNDING_M for what, least_m in found)


def test_flaps_that_reach_over_the_rim_pass_their_neighbours() -> None:
    plan = _plan(*OVER_THE_RIM, "pre_broken")
    assert len(plan.order) == 3
    assert _all_held(*OVER_THE_RIM, "pre_broken", plan)


def test_a_lid_over_short_flaps_is_let_go_where_it_comes_to_rest_closed() -> None:
    seed, number, name = OVER_OTHERS
    plan = _plan(seed, number, "pre_broken")
    assert _plan(seed, number, "pre_broken", PUSHED_HOME).flaps[name].status == "blocked"
    last = [segment for segment in plan.segments if segment.kind == "push" and segment.flap == name][-1]
    assert last.hinge_angle_rad is not None
    assert np.radians(2.0) < last.hinge_angle_rad[-1] < np.radians(12.0)
    assert (plan.flaps[name].rest_rad or 0.0) < np.radians(12.5)
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, "pre_broken", plan)


def test_what_all_else_leaves_open_is_searched_for_more_widely() -> None:
    seed, number, name = LEFT
    plan = _plan(seed, number, "ordinary")
    without = _plan(seed, number, "ordinary", USUAL)
    assert without.flaps[name].status == "blocked"
    assert plan.order == (*without.order, name)
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, "ordinary", plan)


def test_without_wider_searches_the_first_ones_reason_is_told() -> None:
    seed, number, name = LEFT
    told_of = _plan(seed, number, "ordinary", ONE_SEARCH).flaps[name]
    assert told_of.status == "blocked"
    assert "comes too near to" in (told_of.reason or "")


def test_a_flap_is_held_with_the_very_tip_where_nothing_else_reaches_it() -> None:
    seed, number, name = BY_THE_TIP
    plan = _plan(seed, number, "ordinary")
    assert _plan(seed, number, "ordinary", FIRMLY | USUAL).flaps[name].status == "unreachable"
    assert plan.flaps[name].status == "planned"
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, "ordinary", plan)


def test_a_second_push_closes_what_the_first_leaves_half_way() -> None:
    seed, number, name = IN_TWO
    plan = _plan(seed, number, "pre_broken")
    assert _plan(seed, number, "pre_broken", AT_ONE_GO).flaps[name].status == "blocked"
    pushes = [segment for segment in plan.segments if segment.kind == "push" and segment.flap == name]
    assert [segment.gripper_opening_m for segment in pushes] == [0.0, 0.0]
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, "pre_broken", plan)


@pytest.mark.parametrize(
    ("box", "crease", "without"),
    [
        (ASLANT, "pre_broken", SQUARE),
        (NEAR_THE_SUPPORT, "ordinary", WIDE_APART),
    ],
)
def test_what_the_last_searches_find_room_for_is_held(
    box: tuple[int, int, str], crease: str, without: dict[str, Any]
) -> None:
    seed, number, name = box
    plan = _plan(seed, number, crease)
    assert _plan(seed, number, crease, without).flaps[name].status == "blocked"
    assert plan.flaps[name].status == "planned"
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, crease, plan)


def test_where_the_arm_finds_no_way_to_a_flap_the_others_are_planned_as_it_stands() -> None:
    for number, count in STRANDED.items():
        plan = _plan(2013, number, "ordinary", STRAIGHT_ALONE)
        stranded = [name for name, flap in plan.flaps.items() if flap.reason == "no way was found to it"]
        assert len(stranded) == count, f"problem {number}"
        others = [name for name, flap in plan.flaps.items() if name not in stranded]
        model, settings = draw_problem(number, 2013).model, {**told("ordinary"), **STRAIGHT_ALONE}
        without = plan_closing(model, ROBOT, np.eye(4), only=others, settings=settings)
        assert plan.segments, f"problem {number}"
        assert plan.segments == without.segments, f"problem {number}"


def test_flaps_on_stacks_are_taken_to_rest_where_physics_leaves_them() -> None:
    for (seed, number), name in ON_STACKS.items():
        plan = _plan(seed, number, "ordinary")
        run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
        told_rad, left_rad = plan.flaps[name].rest_rad, run.flaps[name].after_rad
        assert told_rad is not None, f"problem {number}"
        assert left_rad is not None, f"problem {number}"
        assert told_rad > np.radians(20.0), f"problem {number}"
        assert abs(told_rad - left_rad) < np.radians(5.0), f"problem {number}"
        assert run.flaps[name].held, f"problem {number}"


def test_fingers_press_flaps_squarely_enough_not_to_slip_off() -> None:
    for seed, number, crease in SQUARELY:
        plan = _plan(seed, number, crease)
        assert plan.order, f"problem {number}"
        assert _all_held(seed, number, crease, plan), f"problem {number}"


def test_a_flap_that_would_meet_the_arms_base_is_left_open() -> None:
    seed, number, name = BY_THE_BASE
    plan = _plan(seed, number, "pre_broken")
    assert (plan.flaps[name].status, plan.flaps[name].reason) == ("blocked", f"base comes too near to {name}")
    assert len(plan.order) == 2
    assert _all_held(seed, number, "pre_broken", plan)


def test_flaps_below_others_are_pressed_down_near_the_hinge_of_those() -> None:
    plan = _plan(*PRESSED_DOWN, "pre_broken")
    assert len(plan.order) == 4
    assert _all_held(*PRESSED_DOWN, "pre_broken", plan)


def test_flaps_that_lie_on_the_rims_are_pressed_no_further_than_boards_let_them() -> None:
    plan = _plan(*ON_RIMS, "pre_broken")
    assert len(plan.order) == 4
    assert _all_held(*ON_RIMS, "pre_broken", plan)


def test_a_flap_that_would_spring_up_off_those_it_lies_on_is_left_open() -> None:
    seed, number, name = SPRINGS_UP
    plan = _plan(seed, number, "ordinary")
    assert (plan.flaps[name].status, len(plan.order)) == ("blocked", 2)
    assert _plan(seed, number, "pre_broken").flaps[name].status == "planned"
    assert "come to lie on the ends of flaps that overlap" in (plan.flaps[name].reason or "")
    assert _all_held(seed, number, "ordinary", plan)


def test_flaps_that_would_jam_on_the_free_edge_of_another_wait() -> None:
    for seed, number in JAMMING:
        plan = _plan(seed, number, "ordinary")
        run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
        assert len(plan.order) >= 3, f"problem {number}"
        assert all(run.flaps[name].held for name in plan.order), f"problem {number}"
        assert run.max_force_n < GENTLE_N, f"problem {number}"
        assert run.box_slid_m < 0.005, f"problem {number}"


def test_flaps_that_would_press_an_end_down_steeply_go_before_it_springs_up() -> None:
    seed, number, order = STEEPLY
    plan = _plan(seed, number, "ordinary")
    run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
    assert plan.order == order
    assert all(run.flaps[name].held for name in order)
    assert run.box_slid_m < 0.005


def test_a_flap_that_presses_an_end_down_steeply_whatever_the_order_comes_last() -> None:
    seed, number, name = STEEPLY_AT_LAST
    plan = _plan(seed, number, "ordinary")
    assert (len(plan.order), plan.order[-1]) == (3, name)
    run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
    assert all(run.flaps[held].held for held in plan.order)
    assert run.box_slid_m < 0.005


def test_what_takes_a_couple_comes_after_the_one_across_that_does_not() -> None:
    seed, number, name = GOES_WRONG
    plan = _plan(seed, number, "ordinary")
    turned = [segment.flap for segment in plan.segments if segment.gripper_opening_m > 0.0 and segment.kind == "push"]
    assert name in turned
    assert plan.order[0] not in turned
    assert len(plan.order) == 3
    assert _all_held(seed, number, "ordinary", plan)


def test_flaps_on_a_lid_are_pressed_a_little_further_where_they_come_to_rest_closed_for_it() -> None:
    seed, number, names = ON_A_LID
    plan = _plan(seed, number, "ordinary")
    run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
    assert run.failure is None
    assert len(plan.order) == 4
    for name in names:
        assert (plan.flaps[name].rest_rad or 0.0) == pytest.approx(np.radians(14.0), abs=0.01)
        assert run.flaps[name].held
        assert run.flaps[name].end_rad < np.radians(15.0)
    assert run.max_force_n < GENTLE_N


def test_a_flap_of_a_flat_box_is_not_pressed_onto_its_base() -> None:
    seed, number, name = ON_THE_BASE
    plan = _plan(seed, number, "ordinary")
    run = simulate(plan, draw_problem(number, seed).model, crease="ordinary").simulation
    assert run.flaps[name].held
    assert (run.flaps[name].pushed_to_rad or 0.0) < 0.0
    assert run.max_force_n < GENTLE_N


def test_a_flap_out_of_reach_is_told_as_such_whatever_is_near_it() -> None:
    seed, number, name = FAR_OFF
    problem = draw_problem(number, seed)
    corners = np.array([part.corners for part in problem.model.objects[0].parts if part.corners is not None])
    middle = corners.mean(axis=(0, 1))[:2]
    base_from_input = np.eye(4)
    base_from_input[:2, 3] = 0.4 * middle / np.linalg.norm(middle)
    flap = plan_closing(problem.model, ROBOT, base_from_input, settings=told("ordinary")).flaps[name]
    assert (flap.status, flap.reason) == ("unreachable", "where it stands: is out of the arm's reach")


@pytest.mark.parametrize("pinned", [HEAVY, SPRINGS_OFF])
def test_a_flap_is_pushed_as_far_as_its_weight_and_its_crease_ask(pinned: tuple[int, int, str]) -> None:
    seed, number, name = pinned
    plan = _plan(seed, number, "ordinary")
    assert plan.flaps[name].status == "planned"
    assert _keeps_clear(seed, number, plan)
    assert _all_held(seed, number, "ordinary", plan)
