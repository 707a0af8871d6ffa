"""Boxes closed in physics: by way, crease, flap and size, from true models and from seen ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import msgspec
import numpy as np
from benchmarks.closing.__main__ import record_of
from benchmarks.closing.problems import COUNT, LATER_SEEDS, REPORT_SEED, SEED
from benchmarks.closing.reasons import kind_of
from benchmarks.closing.record import CREASES, WAYS, FlapRecord, Limits, Record, limits_path
from benchmarks.experiments.lab import Lab
from benchmarks.experiments.report import Cell, Report, Table
from matplotlib.figure import Figure

FOLDER = Path("out/closing")
QUICK_FOLDER = Path("out/closing_quick")
QUICK = 2
FEW = 12
FEW_KINDS = (("layered", "pre_broken"), ("layered", "ordinary"), ("paper", "ordinary"))

ROOM_FOR_LEGEND = 120.0
"""Per cent: above all bars."""

CLAIM = (
    "for the three flaps closer to the arm the planner finds valid paths in 90 % of the experiments, for the farthest "
    "in 50 %."
)

Of = Callable[[Record, FlapRecord], bool]


def run(lab: Lab) -> Report:
    """Tables of the records that are there, else of the first FEW problems; a quick run measures its own."""
    if lab.quick:
        found = [record_of(QUICK_FOLDER, number, "layered", "ordinary") for number in range(QUICK)]
        return report(found, {})
    files = sorted(FOLDER.glob("*_*_*.json"))
    if not files:
        return report([record_of(FOLDER, number, *kind) for kind in FEW_KINDS for number in range(FEW)], {})
    found = [msgspec.json.decode(path.read_bytes(), type=Record) for path in files]
    paths = [limits_path(FOLDER, number) for number in range(COUNT)]
    limits = [msgspec.json.decode(path.read_bytes(), type=Limits) for path in paths if path.is_file()]
    return report(found, {known.number: known for known in limits})


def report(found: list[Record], limits: dict[int, Limits]) -> Report:
    """Tables and picture of records."""
    tables = [_by_way(found), _by_size(found), _boxes(found), _times(found)]
    if limits:
        tables.insert(1, _of_feasible(found, limits))
        tables.insert(2, _feasible_boxes(found, limits))
        tables.append(_reasons(found, limits))
    counts = {way: len({record.number for record in found if record.way == way}) for way in WAYS}
    told = ", ".join(f"{way} {count}" for way, count in counts.items() if count)
    how = (
        "Here: boxes of a set that `benchmarks/closing/problems.py` draws (every size, anywhere before the arm, "
        f"flaps at 40 to 235 degrees) by seed {REPORT_SEED}, after the planner was tuned on those of seeds "
        f"{', '.join(str(seed) for seed in (SEED, *LATER_SEEDS))}; the first of its {COUNT}: {told} "
        "(`python -m benchmarks.closing` measures them; a box that reaches into the arm's ready pose is left out). "
        "`layered` is our planner, `paper` that of 2011, both on true models; "
        "`seen` is ours on models inferred from one simulated frame each, `looking` the same with "
        "a look after each flap (`--replan`); physics closes the true box. Planners are told the class of creases. "
        "Planned, reached, held: share of open flaps with a plan; at 0 (within 2 degrees) while pushed; closed after "
        "all has rested at the end. Runs in which anything sinks in by more than 1 mm prove nothing: none of their "
        "flaps is held. Feasible: a plan of ours or the paper's is there, or brute force finds a motion (hinge angle "
        "every 5 degrees, 10 x 10 contacts, 200 tool directions, 4 turns, all branches), each flap by itself. "
        "Bearable: statics allow a push that neither slides nor tips the box with that class of creases, whatever the "
        "arm can reach."
    )
    return Report("Closing boxes", CLAIM, how, tuple(tables), lambda figure: _draw(found, figure))


def _percent(count: int, total: int) -> Cell:
    return 100.0 * count / total if total else None


def _flaps(found: Iterable[Record], of: Of) -> list[FlapRecord]:
    return [flap for record in found for flap in record.flaps if of(record, flap)]


def _groups(found: list[Record]) -> Iterable[tuple[str, str, str, list[Record], Of]]:
    """By way, crease, and near or farthest flap."""
    for way in WAYS:
        for crease in CREASES:
            mine = [record for record in found if (record.way, record.crease) == (way, crease)]
            if mine:
                yield way, crease, "near", mine, lambda _, flap: not flap.farthest
                yield way, crease, "farthest", mine, lambda _, flap: flap.farthest


def _by_way(found: list[Record]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for way, crease, which, mine, of in _groups(found):
        flaps = _flaps(mine, of)
        counts = [
            sum(flap.status == "planned" for flap in flaps),
            sum(flap.reached for flap in flaps),
            sum(flap.held for flap in flaps),
        ]
        shares = [_percent(count, len(flaps)) for count in counts]
        rows.append((way, crease, which, len(flaps), *shares, _percent(counts[2], counts[0])))
    columns = ("way", "creases", "flaps", "count", "planned %", "reached 0 %", "held %", "held of planned %")
    return Table("Flaps, per cent of all open ones:", columns, rows)


def _asked(found: list[Record], limits: dict[int, Limits]) -> tuple[Of, Of]:
    """Is a flap feasible, and is it bearable?"""
    planned = {
        (record.number, flap.name)
        for record in found
        if record.way in ("layered", "paper")
        for flap in record.flaps
        if flap.status == "planned"
    }

    def feasible(record: Record, flap: FlapRecord) -> bool:
        return (record.number, flap.name) in planned or limits[record.number].feasible.get(flap.name, False)

    def bearable(record: Record, flap: FlapRecord) -> bool:
        return limits[record.number].bearable[record.crease].get(flap.name, True)

    return feasible, bearable


def _of_feasible(found: list[Record], limits: dict[int, Limits]) -> Table:
    feasible, bearable = _asked(found, limits)
    rows: list[tuple[Cell, ...]] = []
    known = [record for record in found if record.number in limits and record.way in ("layered", "paper")]
    for way, crease, which, mine, of in _groups(known):
        flaps = _flaps(mine, of)
        can = _flaps(mine, lambda record, flap, of=of: of(record, flap) and feasible(record, flap))
        both = _flaps(
            mine, lambda record, flap, of=of: of(record, flap) and feasible(record, flap) and bearable(record, flap)
        )
        rows.append(
            (way, crease, which, len(flaps), len(can), _percent(sum(flap.held for flap in can), len(can)),
             len(both), _percent(sum(flap.held for flap in both), len(both)))
        )  # fmt: skip
    columns = (
        "way", "creases", "flaps", "count", "feasible", "held of these %", "and bearable", "held of those %"
    )  # fmt: skip
    return Table(f"Flaps that can be closed at all ({len(limits)} boxes):", columns, rows)


def _feasible_boxes(found: list[Record], limits: dict[int, Limits]) -> Table:
    """Boxes of four open flaps, each of them feasible: all four held at the end?"""
    feasible, bearable = _asked(found, limits)
    rows: list[tuple[Cell, ...]] = []
    for way in ("layered", "paper"):
        for crease in CREASES:
            mine = [r for r in found if r.number in limits and (r.way, r.crease, len(r.flaps)) == (way, crease, 4)]
            if not mine:
                continue
            can = [record for record in mine if all(feasible(record, flap) for flap in record.flaps)]
            both = [record for record in can if all(bearable(record, flap) for flap in record.flaps)]
            held = [sum(all(flap.held for flap in record.flaps) for record in some) for some in (can, both)]
            rows.append(
                (way, crease, len(mine), len(can), _percent(held[0], len(can)), len(both),
                 _percent(held[1], len(both)))
            )  # fmt: skip
    columns = (
        "way", "creases", "boxes of four", "each flap feasible", "all four held %", "and bearable",
        "all four held of those %",
    )  # fmt: skip
    return Table("Boxes whose four flaps can each be closed at all:", columns, rows)


def _reasons(found: list[Record], limits: dict[int, Limits]) -> Table:
    """Feasible flaps that are not held, by why, the commonest first."""
    feasible, _ = _asked(found, limits)
    creases = CREASES[:2]
    counts: dict[str, list[int]] = {}
    for record in found:
        if record.way == WAYS[0] and record.crease in creases and record.number in limits:
            for flap in record.flaps:
                if feasible(record, flap) and not flap.held:
                    counted = counts.setdefault(
                        kind_of(flap.status, flap.reason, record.failure, record.stopped), [0] * (2 * len(creases))
                    )
                    counted[2 * creases.index(record.crease) + flap.farthest] += 1
    rows: list[tuple[Cell, ...]] = [
        (kind, *counted) for kind, counted in sorted(counts.items(), key=lambda row: (-sum(row[1]), row[0]))
    ]
    columns = ("why", *(f"{crease}: {which}" for crease in creases for which in ("near", "farthest")))
    return Table("Feasible flaps that are not held at the end, layered planner:", columns, rows)


def _by_size(found: list[Record]) -> Table:
    mine = [record for record in found if record.way == WAYS[0]]
    rows: list[tuple[Cell, ...]] = []
    for category in [*dict.fromkeys(record.category for record in mine), "all"]:
        row: list[Cell] = [category]
        for crease in CREASES:
            some = [r for r in mine if category in (r.category, "all") and r.crease == crease]
            flaps = _flaps(some, lambda *_: True)
            row += [
                len(flaps),
                _percent(sum(flap.status == "planned" for flap in flaps), len(flaps)),
                _percent(sum(flap.held for flap in flaps), len(flaps)),
            ]
        rows.append(tuple(row))
    columns = ["boxes"]
    for crease in CREASES:
        columns += [f"{crease}: flaps", f"{crease}: planned %", f"{crease}: held %"]
    return Table("Flaps by size of box, layered planner:", tuple(columns), rows)


def _boxes(found: list[Record]) -> Table:
    """Whole boxes: those whose open flaps all have a plan, and of these the ones whose flaps are all held."""
    rows: list[tuple[Cell, ...]] = []
    for way in WAYS:
        for crease in CREASES:
            mine = [record for record in found if (record.way, record.crease) == (way, crease) and record.flaps]
            if not mine:
                continue
            whole = [r for r in mine if all(flap.status == "planned" for flap in r.flaps)]
            closed = sum(all(flap.held for flap in record.flaps) for record in whole)
            four = [record for record in whole if len(record.flaps) == 4]
            four_closed = sum(all(flap.held for flap in record.flaps) for record in four)
            rows.append(
                (way, crease, len(mine), len(whole), _percent(closed, len(whole)), len(four),
                 _percent(four_closed, len(four)), sum(r.failure is not None for r in mine),
                 float(np.median([r.most_force_n for r in mine])), 1e3 * float(np.max([r.slid_m for r in mine])),
                 sum(r.unwanted > 0 for r in mine))
            )  # fmt: skip
    columns = (
        "way", "creases", "boxes", "all planned", "all closed %", "of four flaps", "all four closed %",
        "proves nothing", "median of most force, N", "farthest slide, mm", "with unwanted touches",
    )  # fmt: skip
    return Table("Boxes:", columns, rows)


def _times(found: list[Record]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for way in ("layered", "paper"):
        for count in (4, 3, 2, 1):
            times = [r.planning_s for r in found if r.way == way and len(r.flaps) == count]
            if times:
                rows.append((way, count, len(times), float(np.median(times)), float(np.percentile(times, 95))))
    columns = ("way", "open flaps", "plans", "median", "95 %")
    return Table("Planning, one thread, s of the processor:", columns, rows, digits=2)


def _draw(found: list[Record], figure: Figure) -> None:
    axes: Sequence = figure.subplots(1, 2, sharey=True)
    for axis, far in zip(axes, ("near", "farthest"), strict=True):
        names, planned, held = [], [], []
        for way, crease, which, mine, of in _groups(found):
            if which == far:
                flaps = _flaps(mine, of)
                names.append(f"{way}\n{crease.replace('_', '-')}")
                planned.append(_percent(sum(flap.status == "planned" for flap in flaps), len(flaps)) or 0.0)
                held.append(_percent(sum(flap.held for flap in flaps), len(flaps)) or 0.0)
        places = np.arange(len(names))
        axis.bar(places - 0.2, planned, 0.4, label="planned")
        axis.bar(places + 0.2, held, 0.4, label="held in physics")
        axis.set_xticks(places, names, fontsize=5, rotation=45)
        axis.set_title(f"{far} flaps", fontsize=9)
    axes[0].set_ylabel("% of open flaps")
    axes[0].set_ylim(0.0, ROOM_FOR_LEGEND)
    axes[0].legend(fontsize=7, loc="upper right", ncols=2)
