"""Which flaps count for the exit status of `plan`, `simulate` and `close`."""

from __future__ import annotations

from typing import Literal

import pytest

from boxwright.cli.plan_report import NOT_CLOSED, exit_status
from boxwright.cli.simulate_report import all_as_planned, all_closed
from boxwright.types import FlapOutcome, FlapVerdict, Plan, Simulation


def _plan(**statuses: str) -> Plan:
    return Plan(
        format="boxwright.plan",
        version=1,
        robot="arm",
        base_from_input=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)),
        joint_names=("joint_1",),
        order=tuple(name for name, status in statuses.items() if status == "planned"),
        flaps={
            name: FlapOutcome(status=status, reason=None if status == "planned" else "so", seconds=0.0)  # type: ignore[arg-type]
            for name, status in statuses.items()
        },
        segments=(),
        method="layered",
    )


def _run(box: Literal["inferred", "true"] = "true", failure: str | None = None, **held: bool) -> Simulation:
    return Simulation(
        format="boxwright.simulation",
        version=1,
        robot="arm",
        box=box,
        crease="ordinary",
        mass_kg=1.0,
        contents_kg=0.0,
        time_step_s=0.001,
        flaps={
            name: FlapVerdict(
                before_rad=1.5, pushed_to_rad=None, after_rad=0.0, end_rad=0.0, closed=held_now, held=held_now,
                crease_n_m=1.0,
            )
            for name, held_now in held.items()
        },
        box_slid_m=0.0,
        box_turned_rad=0.0,
        max_force_n=0.0,
        max_penetration_m=0.0,
        max_joint_error_rad=0.0,
        unwanted=(),
        failure=failure,
        warnings=(),
        simulated_s=1.0,
        seconds=1.0,
    )  # fmt: skip


@pytest.mark.parametrize("status", ["hidden", "unreachable", "joint_limit", "blocked", "out_of_time"])
def test_a_flap_that_is_not_planned_is_3_but_for_a_hidden_one_that_is_not_there(status: str) -> None:
    plan = _plan(flap_0="planned", flap_1=status, flap_2="already_closed", flap_3="absent")
    assert exit_status(plan) == NOT_CLOSED
    assert exit_status(plan, {"flap_0"}) == NOT_CLOSED
    assert exit_status(plan, {"flap_1"}) == (0 if status == "hidden" else NOT_CLOSED)


def test_of_a_true_box_it_is_known_which_flaps_it_lacks() -> None:
    plan = _plan(flap_0="planned", flap_1="hidden")
    assert all_as_planned(_run(flap_0=True), plan)
    assert not all_as_planned(_run("inferred", flap_0=True), plan)
    assert not all_as_planned(_run(flap_0=True, flap_1=False), plan)
    assert not all_as_planned(_run(flap_0=False), plan)


def test_all_flaps_of_the_box_count_whoever_planned_them_and_tucks_do_not() -> None:
    assert all_closed(_run(flap_0=True, flap_1=True, tuck_1=False))
    assert not all_closed(_run(flap_0=True, flap_1=False))
    assert not all_closed(_run(failure="it sank", flap_0=False))
