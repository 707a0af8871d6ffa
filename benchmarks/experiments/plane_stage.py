"""The share of the true panels that each front end finds."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from benchmarks.experiments.accuracy import PERCENT
from benchmarks.experiments.frames import Look
from benchmarks.experiments.lab import Lab
from benchmarks.experiments.report import Report, Table
from benchmarks.planes_recall import MIN_IOU, MIN_READINGS, ROLES, judge
from matplotlib.figure import Figure

from boxwright.learning import SeenFrame
from boxwright.simulation import CATEGORIES

FRONT_ENDS = ("ransac", "grid")
READINGS = (500, 1000, 2000, 4000, 8000, 16000, 10**7)
TEST_FRAMES = 90

Panel = tuple[str, str, int, bool]
"""Category of its frame, role, readings, whether it is found."""


def run(lab: Lab) -> Report:
    """Both front ends on the same frames."""
    looks = lab.looks(lab.tests, lab.size(TEST_FRAMES, 3))
    panels = {name: _panels(looks, name) for name in FRONT_ENDS}
    return Report(
        title="Planes found",
        claim='"planes can be obtained by almost 100 % accuracy".',
        how=(
            f"{len(looks)} simulated frames as `boxwright synth` draws them; panels of at least {MIN_READINGS} "
            f"readings; found where a segment's readings have an intersection over union of at least {MIN_IOU} "
            "with the panel's. `ransac` is the paper's stage. A flap in the plane of its side is one plane to "
            "any front end, and one of the two is missed."
        ),
        tables=(
            _table("By role:", "role", panels, [(role, lambda p, r=role: p[1] == r) for role in ROLES]),
            _table("By category:", "category", panels, [(c, lambda p, c=c: p[0] == c) for c in CATEGORIES]),
            _table(
                "By readings:",
                "readings",
                panels,
                [(_span(a, b), lambda p, a=a, b=b: a <= p[2] < b) for a, b in _spans()],
            ),
        ),
        draw=lambda figure: _draw(figure, panels),
        size_in=(7.0, 3.4),
    )


def _panels(looks: list[Look], front_end: str) -> list[Panel]:
    return [panel for look in looks for panel in _panels_of(getattr(look, front_end))]


def _panels_of(frame: SeenFrame) -> list[Panel]:
    judged = judge(frame.name, frame.truth, frame.truth_labels.astype(np.int64), frame.perception, 0.0)
    roles = [next(r for r in ROLES if name.split(":")[1].startswith(r)) for name, *_ in judged.panels]
    return [
        (frame.truth.category, role, readings, iou >= MIN_IOU)
        for role, (_, readings, iou, _) in zip(roles, judged.panels, strict=True)
    ]


def _table(title: str, first: str, panels: dict[str, list[Panel]], rows: list) -> Table:
    cells = []
    for label, belongs in [*rows, ("all", lambda p: True)]:
        mine = {name: [p[3] for p in panels[name] if belongs(p)] for name in FRONT_ENDS}
        shares = [PERCENT * float(np.mean(found)) if found else None for found in mine.values()]
        cells.append((label, len(mine[FRONT_ENDS[0]]), *shares))
    return Table(title, (first, "panels", *(f"{name}, found %" for name in FRONT_ENDS)), cells)


def _spans() -> list[tuple[int, int]]:
    return list(pairwise(READINGS))


def _span(low: int, high: int) -> str:
    return f"{low} to {high}" if high < READINGS[-1] else f"{low} or more"


def _draw(figure: Figure, panels: dict[str, list[Panel]]) -> None:
    axes = figure.subplots()
    x = np.arange(len(_spans()))
    for name in FRONT_ENDS:
        shares = []
        for low, high in _spans():
            found = [p[3] for p in panels[name] if low <= p[2] < high]
            shares.append(PERCENT * float(np.mean(found)) if found else np.nan)
        axes.plot(x, shares, "o-", ms=4, label=f"planes={name}")
    axes.set_xticks(x, [_span(*span) for span in _spans()], fontsize=8)
    axes.set_ylim(0, 102)
    axes.set_xlabel("readings on the panel")
    axes.set_ylabel("panels found (%)")
    axes.legend(loc="lower right")
