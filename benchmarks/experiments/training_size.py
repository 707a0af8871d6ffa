"""Accuracy against the number of training frames."""

from __future__ import annotations

import numpy as np
from benchmarks.experiments.accuracy import boxes_of, flap_percent, full_percent, plus_minus, spread
from benchmarks.experiments.lab import Lab, model_of
from benchmarks.experiments.report import Report, Table
from matplotlib.figure import Figure

from boxwright.models import load_template

DRAWS = {2: 8, 5: 6, 12: 5, 25: 3, 50: 2, 100: 2, 200: 1}
"""How many sets of that many frames are drawn from the training frames."""
TEST_FRAMES = 80
SEED = 200

Accuracies = list[tuple[float | None, float | None]]


def run(lab: Lab) -> Report:
    """Every number of frames, drawn several times where it is small."""
    draws, test_count = lab.size((DRAWS, TEST_FRAMES), ({2: 1, 3: 1}, 2))
    pool = lab.frames(lab.training, max(draws))
    tests = lab.frames(lab.tests, test_count)
    template = load_template("carton")
    rng = np.random.default_rng(SEED)
    found: dict[int, Accuracies] = {}
    for count, times in draws.items():
        found[count] = []
        for number in range(times):
            chosen = rng.choice(len(pool), count, replace=False)
            learned = lab.learned(("of", count, number), template, [pool[k] for k in chosen])
            boxes = boxes_of(lab.scores([model_of(template, learned)], tests))
            found[count].append((flap_percent(boxes), full_percent(boxes)))
    rows = [
        (count, len(pairs), plus_minus(p[0] for p in pairs), plus_minus(p[1] for p in pairs))
        for count, pairs in found.items()
    ]
    return Report(
        title="How many frames to learn from",
        claim="12 of its 50 point clouds are for training.",
        how=(
            f"Frames drawn from {max(draws)} simulated ones of six categories; tested on {test_count} others "
            "(planes by RANSAC, one template, staged search). Mean ± standard deviation over the draws, which "
            "share frames where they are large."
        ),
        tables=(Table("On the test frames:", ("training frames", "draws", "flap %", "full %"), rows),),
        draw=lambda figure: _draw(figure, found),
        size_in=(7.0, 3.4),
    )


def _draw(figure: Figure, found: dict[int, Accuracies]) -> None:
    axes = figure.subplots()
    for k, label in enumerate(("flap accuracy", "full model accuracy")):
        means = [spread(pair[k] for pair in pairs) or (np.nan, 0.0) for pairs in found.values()]
        errors = [sd for _, sd in means]
        axes.errorbar(list(found), [mean for mean, _ in means], yerr=errors, fmt="o-", ms=4, capsize=3, label=label)
    axes.set_xscale("log")
    axes.set_xticks(list(found), [str(count) for count in found])
    axes.minorticks_off()
    axes.axvline(12, color="0.6", ls=":", lw=1.0)
    axes.set_xlabel("training frames (dotted: the paper's 12)")
    axes.set_ylabel("(right - wrong) / panels, mean over boxes (%)", fontsize=8)
    axes.legend(loc="lower right")
