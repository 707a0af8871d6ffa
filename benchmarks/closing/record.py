"""What became of one problem: its plans and their runs in physics, as one file, so that a set can be run in pieces."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import msgspec
import numpy as np
from benchmarks.closing.problems import Problem, draw_problem

from boxwright.planning import plan_closing
from boxwright.simulation.physics import simulate
from boxwright.types import Simulation

ROBOT = "viper_s850"
METHODS = ("layered", "paper")
CREASES = ("pre_broken", "ordinary", "stiff")
REACHED_RAD = math.radians(2.0)
"""A servo brings a flap this near to 0 where the plan pushes it to 0 or beyond."""


class FlapRecord(msgspec.Struct, frozen=True):
    """A flap under one planner: its status, and by crease class whether physics closed it while pushed, and held it."""

    name: str
    farthest: bool
    status: str
    feasible: bool | None
    """As brute force has it; a plan proves it too. None where it was not asked."""
    reached: dict[str, bool]
    held: dict[str, bool]


class Record(msgspec.Struct, frozen=True):
    """One problem under one planner."""

    number: int
    category: str
    method: str
    seconds: float
    flaps: tuple[FlapRecord, ...]
    failures: dict[str, str]
    """Runs in physics that prove nothing, by crease class."""


def measure(problem: Problem, method: str, creases: Sequence[str], feasible: dict[str, bool] | None = None) -> Record:
    """Plans and simulates; the slowest part is physics."""
    plan = plan_closing(problem.model, ROBOT, np.eye(4), method=method)
    runs = {crease: simulate(plan, problem.model, crease=crease).simulation for crease in creases if plan.segments}
    farthest = _farthest(problem)
    flaps = tuple(
        FlapRecord(
            name=name,
            farthest=name == farthest,
            status=outcome.status,
            feasible=True if outcome.status == "planned" else (feasible or {}).get(name),
            reached={crease: _reached(run, name) for crease, run in runs.items()},
            held={
                crease: run.failure is None and name in run.flaps and run.flaps[name].held
                for crease, run in runs.items()
            },
        )
        for name, outcome in plan.flaps.items()
        if outcome.status not in ("absent", "hidden")
    )
    failures = {crease: run.failure for crease, run in runs.items() if run.failure is not None}
    return Record(problem.number, problem.category, method, plan.seconds, flaps, failures)


def records(folder: Path, numbers: Sequence[int], methods: Sequence[str], creases: Sequence[str]) -> list[Record]:
    """Those of the folder, and those that it lacks, which are measured and kept there."""
    folder.mkdir(parents=True, exist_ok=True)
    found = []
    for number in numbers:
        for method in methods:
            path = folder / f"{number:03d}_{method}.json"
            if not path.is_file():
                record = measure(draw_problem(number), method, creases)
                path.write_bytes(msgspec.json.encode(record))
            found.append(msgspec.json.decode(path.read_bytes(), type=Record))
    return found


def _farthest(problem: Problem) -> str:
    """The flap whose hinge's middle is farthest from the J1 axis."""
    hinges = [joint for joint in problem.box.joints if joint.name.startswith("flap")]
    return max(hinges, key=lambda joint: float(np.hypot(joint.origin[0], joint.origin[1]))).name


def _reached(run: Simulation, name: str) -> bool:
    """Was it at 0, or beyond, while it was pushed?"""
    flap = run.flaps.get(name)
    return flap is not None and flap.pushed_to_rad is not None and flap.pushed_to_rad <= REACHED_RAD
