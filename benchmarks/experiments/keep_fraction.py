"""c, the share of the candidate list that is ranked with every relation: from which c on does the answer stay?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from benchmarks.experiments.accuracy import PERCENT, boxes_of, flap_percent, full_percent
from benchmarks.experiments.lab import EXACT, Lab, model_of
from benchmarks.experiments.report import Report, Table
from matplotlib.figure import Figure

from boxwright import _core
from boxwright.learning import SeenFrame
from boxwright.models import load_template, load_weights

FRACTIONS = tuple(2.0**-k for k in range(6, -1, -1))
EXPONENTS = (3, 4)
"""Of the first stage's cost: the lower, the more relations are left out, the least important first."""
WITHIN = 1e-9
"""Scores that differ by no more are equal."""
SMALLEST = 5
"""Groups of fewer segments have hardly a choice."""


@dataclass(frozen=True)
class Found:
    """One setting: shares of the groups whose answer scores as that of c = 1, and as the best there is; accuracies."""

    exponent: int
    fraction: float
    as_at_one: float
    as_exact: float
    mean_deficit: float
    flap: float | None
    full: float | None


def run(lab: Lab) -> Report:
    """All fractions for each exponent, on the same groups."""
    count, fractions = lab.size((90, FRACTIONS), (3, (0.25, 1.0)))
    frames = lab.frames(lab.tests, count)
    template, learned = load_template("carton"), load_weights("carton", "ransac")
    problems = [p for f in frames for p in _core.Problem.by_group(f.perception, template) if len(p) >= SMALLEST]
    weights = learned.vector(template)
    importance = np.array([learned.importance[n] for n in template.feature_names + template.relation_names])
    best = np.array(lab.each(lambda p: p.solve(weights)[1][0], problems))
    found = []
    for exponent in EXPONENTS:

        def scores(fraction: float, exponent: int = exponent) -> np.ndarray:
            setting = {"keep_fraction": fraction, "max_exponent": exponent}
            return np.array(lab.each(lambda p: p.rank(weights, importance, 1, **setting)[1][0], problems))

        whole = scores(1.0)
        for fraction in fractions:
            own = whole if fraction == 1.0 else scores(fraction)
            as_at_one, as_exact = (PERCENT * float(np.mean(own >= high - WITHIN)) for high in (whole, best))
            accuracies = _accuracy(lab, frames, {"keep_fraction": fraction, "max_exponent": exponent})
            found.append(Found(exponent, fraction, as_at_one, as_exact, float(np.mean(best - own)), *accuracies))
    limits = {"exact": _accuracy(lab, frames, EXACT), "every relation in": _accuracy(lab, frames, {})}
    return Report(
        title="c, the share of the candidates that are ranked with every relation",
        claim='"as c becomes larger than 1/4, the optimal solution converges to the predicted" one.',
        how=(
            f"{len(problems)} groups of at least {SMALLEST} segments in {count} simulated frames (planes by RANSAC, "
            "the shipped carton weights). c says something only where relations are left out of the first stage, so "
            "its cost is held to n^4 and n^3 here (n^3 leaves a tree, which is solved in n^2: a list of one); with "
            "every relation in (n^5, as shipped up to 25 segments) the first stage is proven and c has no part. The "
            "list holds one completion for each combination of the parts that are fixed. *As at c = 1* and *as "
            "exact*: share of the groups whose answer scores as high; *deficit*: mean of what the score lacks."
        ),
        tables=(_table(found), _limits(limits)),
        draw=lambda figure: _draw(figure, found, limits["exact"][1]),
    )


def _accuracy(lab: Lab, frames: list[SeenFrame], search: dict[str, float | str]) -> tuple[float | None, float | None]:
    model = model_of(load_template("carton"), load_weights("carton", "ransac"), search)
    boxes = boxes_of(lab.scores([model], frames, search))
    return flap_percent(boxes), full_percent(boxes)


def _table(found: list[Found]) -> Table:
    rows = [
        (f"n^{f.exponent}", _as_text(f.fraction), f.as_at_one, f.as_exact, f"{f.mean_deficit:.4f}", f.flap, f.full)
        for f in found
    ]
    columns = ("first stage", "c", "as at c = 1, %", "as exact, %", "deficit", "flap %", "full %")
    return Table("Every setting:", columns, rows)


def _limits(limits: dict[str, tuple[float | None, float | None]]) -> Table:
    return Table("Without c:", ("search", "flap %", "full %"), [(name, *pair) for name, pair in limits.items()])


def _as_text(fraction: float) -> str:
    return "1" if fraction == 1.0 else f"1/{round(1 / fraction)}"


def _draw(figure: Figure, found: list[Found], exact_full: float | None) -> None:
    left, right = figure.subplots(1, 2)
    for exponent in EXPONENTS:
        mine = [f for f in found if f.exponent == exponent]
        fractions = [f.fraction for f in mine]
        left.plot(fractions, [f.as_at_one for f in mine], "o-", ms=4, label=f"first stage n^{exponent}")
        right.plot(fractions, [np.nan if f.full is None else f.full for f in mine], "o-", ms=4)
    if exact_full is not None:
        right.axhline(exact_full, color="0.4", ls="--", lw=1.0)
        right.annotate("exact search", (1.0, exact_full), ha="right", va="bottom", color="0.4", xytext=(0, 2),
                       textcoords="offset points")  # fmt: skip
    for axes in (left, right):
        ticks = [f for f in FRACTIONS if f in {g.fraction for g in found}]
        axes.set_xscale("log", base=2)
        axes.set_xticks(ticks, [_as_text(f) for f in ticks])
        axes.axvline(0.25, color="0.6", ls=":", lw=1.0)
        axes.set_xlabel("c (dotted: the paper's 1/4)")
    left.set_ylabel("groups answered as at c = 1 (%)")
    right.set_ylabel("full model accuracy (%)")
    left.legend(loc="lower right")
