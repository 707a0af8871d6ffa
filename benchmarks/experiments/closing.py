"""Boxes closed in physics: by planner, crease, flap and size, from models that are true."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import numpy as np
from benchmarks.closing.problems import COUNT
from benchmarks.closing.record import CREASES, METHODS, FlapRecord, Record, records
from benchmarks.experiments.lab import Lab
from benchmarks.experiments.report import Cell, Report, Table
from matplotlib.figure import Figure

FOLDER = Path("out/closing")
QUICK_FOLDER = Path("out/closing_quick")
QUICK = 2

CLAIM = (
    "for the three flaps closer to the arm the planner finds valid paths in 90 % of the experiments, for the farthest "
    "in 50 %."
)


def run(lab: Lab) -> Report:
    """Measures what the folder lacks."""
    count, creases = lab.size(COUNT, QUICK), lab.size(CREASES, ("ordinary",))
    found = records(lab.size(FOLDER, QUICK_FOLDER), range(count), METHODS, creases)
    return report(found, creases)


def report(found: list[Record], creases: tuple[str, ...]) -> Report:
    """Tables and picture of records."""
    tables = (_by_planner(found, creases), _by_size(found, creases), _times(found))
    boxes = len({record.number for record in found})
    how = (
        f"Here: {boxes} boxes of the set that `benchmarks/closing/problems.py` draws (every size, anywhere before the "
        "arm, flaps at 40 to 235 degrees), planned on their true models and closed in physics. Planned: share of open "
        "flaps with a plan. Reached: at 0 (within 2 degrees) while pushed. Held: closed after everything rested, and "
        "at the end; runs in which anything sinks in by more than 1 mm prove nothing and count as not held. All "
        "closed: boxes whose open flaps are all held, of those whose open flaps are all planned. A flap that the "
        "planner closes is feasible; `_core.feasible_flaps` asks brute force about the others."
    )
    return Report("Closing boxes", CLAIM, how, tables, lambda figure: _draw(found, creases, figure))


def _open_flaps(found: Iterable[Record], of: Callable[[FlapRecord], bool]) -> list[FlapRecord]:
    return [flap for record in found for flap in record.flaps if flap.status != "already_closed" and of(flap)]


def _percent(count: int, total: int) -> Cell:
    return 100.0 * count / total if total else None


def _by_planner(found: list[Record], creases: tuple[str, ...]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for method in METHODS:
        mine = [record for record in found if record.method == method]
        for name, of in (("near", lambda flap: not flap.farthest), ("farthest", lambda flap: flap.farthest)):
            flaps = _open_flaps(mine, of)
            planned = [flap for flap in flaps if flap.status == "planned"]
            for crease in creases:
                reached = sum(flap.reached.get(crease, False) for flap in planned)
                held = sum(flap.held.get(crease, False) for flap in planned)
                rows.append(
                    (method, name, crease, len(flaps), _percent(len(planned), len(flaps)),
                     _percent(reached, len(flaps)), _percent(held, len(flaps)), _percent(held, len(planned)))
                )  # fmt: skip
    columns = ("planner", "flaps", "creases", "count", "planned %", "reached %", "held %", "held of planned %")
    return Table("Flaps, per cent of all open ones:", columns, rows)


def _by_size(found: list[Record], creases: tuple[str, ...]) -> Table:
    crease = "ordinary" if "ordinary" in creases else creases[0]
    mine = [record for record in found if record.method == METHODS[0]]
    rows: list[tuple[Cell, ...]] = []
    for category in [*dict.fromkeys(record.category for record in mine), "all"]:
        some = [record for record in mine if category in (record.category, "all")]
        flaps = _open_flaps(some, lambda _: True)
        whole = [
            record for record in some if all(flap.status in ("planned", "already_closed") for flap in record.flaps)
        ]
        closed = sum(
            all(flap.held.get(crease, False) for flap in record.flaps if flap.status == "planned") for record in whole
        )
        nothing = sum(crease in record.failures for record in some)
        planned = sum(flap.status == "planned" for flap in flaps)
        held = sum(flap.held.get(crease, False) for flap in flaps)
        rows.append(
            (category, len(some), _percent(planned, len(flaps)), _percent(held, len(flaps)), len(whole),
             _percent(closed, len(whole)), nothing)
        )  # fmt: skip
    columns = (
        "boxes",
        "count",
        "flaps planned %",
        "flaps held %",
        "all planned",
        "all closed %",
        "runs that prove nothing",
    )
    return Table(f"Boxes by size, layered planner, {crease} creases:", columns, rows)


def _times(found: list[Record]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for method in METHODS:
        for count in (4, 3, 2, 1):
            times = [r.seconds for r in found if r.method == method and len(r.flaps) == count]
            if times:
                rows.append((method, count, len(times), float(np.median(times)), float(np.percentile(times, 95))))
    return Table("Planning, one thread, s:", ("planner", "flaps", "boxes", "median", "95 %"), rows, digits=2)


def _draw(found: list[Record], creases: tuple[str, ...], figure: Figure) -> None:
    axes = figure.subplots(1, 2, sharey=True)
    for axis, far in zip(axes, (False, True), strict=True):
        names, planned, held = [], [], []
        for method in METHODS:
            flaps = _open_flaps([r for r in found if r.method == method], lambda flap, far=far: flap.farthest == far)
            for crease in creases:
                names.append(f"{method}\n{crease}")
                planned.append(_percent(sum(flap.status == "planned" for flap in flaps), len(flaps)) or 0.0)
                held.append(_percent(sum(flap.held.get(crease, False) for flap in flaps), len(flaps)) or 0.0)
        places = np.arange(len(names))
        axis.bar(places - 0.2, planned, 0.4, label="planned")
        axis.bar(places + 0.2, held, 0.4, label="held in physics")
        axis.set_xticks(places, names, fontsize=6)
        axis.set_title("farthest flaps" if far else "nearer flaps", fontsize=9)
    axes[0].set_ylabel("% of open flaps")
    axes[0].legend(fontsize=7)
