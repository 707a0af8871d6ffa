"""Plans a problem and closes it in physics; asks brute force and statics what can be asked of it."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence

import numpy as np
from benchmarks.closing.creases import told
from benchmarks.closing.problems import Problem
from benchmarks.closing.record import CREASES, FlapRecord, Limits, Record
from benchmarks.closing.seen import Seen, close_seen

from boxwright.planning import ask_bearable, ask_feasible, measured_box, plan_closing
from boxwright.simulation.physics import modelled_box, simulate
from boxwright.types import Simulation

ROBOT = "viper_s850"
REACHED_RAD = math.radians(2.0)
"""A servo brings a flap this near to 0 where the plan pushes it to 0 or beyond."""
OPEN_RAD = math.radians(15.0)


def measure(problem: Problem, way: str, crease: str) -> Record:
    """One record; the slowest part is physics, and with looks the frames."""
    if way in ("seen", "looking"):
        return _record(problem, way, crease, close_seen(problem, ROBOT, crease, told(crease), again=way == "looking"))
    started_s = time.process_time()
    plan = plan_closing(problem.model, ROBOT, np.eye(4), method=way, settings=told(crease))
    planning_s = time.process_time() - started_s
    box = modelled_box(problem.box, problem.model.up, np.eye(4))
    simulation = simulate(plan, problem.model, crease=crease).simulation if plan.segments else None
    statuses = {name: flap.status for name, flap in plan.flaps.items()}
    reasons = {name: flap.reason for name, flap in plan.flaps.items()}
    return _record(problem, way, crease, Seen(box, statuses, reasons, planning_s, simulation))


def limits(problem: Problem, planned: Sequence[str]) -> Limits:
    """Brute force about the open flaps that are not among `planned`, statics about all of them."""
    box = measured_box(problem.model, 0, np.eye(4))
    bearable = {crease: ask_bearable(box, told(crease)) for crease in CREASES}
    asked = [name for name in bearable[CREASES[0]] if name not in planned]
    return Limits(problem.number, ask_feasible(ROBOT, box, asked) if asked else {}, bearable)


def _record(problem: Problem, way: str, crease: str, seen: Seen) -> Record:
    run = seen.simulation
    hinges = {board.name: hinge for board, hinge in seen.box.hinged if board.name.startswith("flap")}
    farthest = max(hinges, key=lambda name: float(np.hypot(*hinges[name].origin[:2])))
    flaps = tuple(
        FlapRecord(
            name=name,
            farthest=name == farthest,
            status=seen.statuses.get(name, "not seen"),
            reached=_reached(run, name),
            held=run is not None and run.failure is None and run.flaps[name].held,
            reason=seen.reasons.get(name),
        )
        for name, hinge in sorted(hinges.items())
        if abs(hinge.position_rad) > OPEN_RAD
    )
    return Record(
        number=problem.number,
        category=problem.category,
        way=way,
        crease=crease,
        flaps=flaps,
        planning_s=seen.planning_s,
        failure=None if run is None else run.failure,
        most_force_n=0.0 if run is None else run.max_force_n,
        slid_m=0.0 if run is None else run.box_slid_m,
        unwanted=0 if run is None else len(run.unwanted),
        stopped=None if run is None or run.stopped is None else run.stopped.line(),
    )


def _reached(run: Simulation | None, name: str) -> bool:
    """Was it at 0, or beyond, while it was pushed?"""
    pushed_to_rad = None if run is None else run.flaps[name].pushed_to_rad
    return pushed_to_rad is not None and pushed_to_rad <= REACHED_RAD
