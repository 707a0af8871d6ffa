"""Candidate assignments to learn from: the truth, its corruptions, and what today's weights like best."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.problems import Assignments, LearningProblem

TOP = 200
"""Candidates that the current weights rank highest."""

CORRUPTIONS = 100
"""Corruptions of one panel, and of two, of each box's truth, at most."""

SHARES = {"truth": 0.1, "one panel": 0.25, "two panels": 0.15, "top": 0.5}
"""How much each kind of candidate weighs among those of one problem, together 1."""


def candidates(
    learning: LearningProblem, weights: NDArray[np.float64], importance: NDArray[np.float64], seed: int
) -> tuple[Assignments, NDArray[np.float64]]:
    """The candidates (K, parts) of a problem, each once, and their sample weights (K,), which sum to 1.

    `weights` and `importance` (terms,) are the current ones. Equal arguments give equal candidates.
    """
    rng = np.random.default_rng(seed)
    segments = len(learning.problem)
    kinds = {
        "truth": learning.truths,
        "one panel": _corrupt(learning.truths, segments, 1, rng),
        "two panels": _corrupt(learning.truths, segments, 2, rng),
        "top": learning.problem.rank(weights, importance, TOP)[0],
    }
    rows, sample_weights = [], []
    for kind, assignments in kinds.items():
        rows.append(assignments)
        sample_weights.append(np.full(len(assignments), SHARES[kind] / max(len(assignments), 1)))
    distinct, index = np.unique(np.concatenate(rows), axis=0, return_inverse=True)
    totals = np.bincount(index.ravel(), weights=np.concatenate(sample_weights), minlength=len(distinct))
    return distinct, totals / totals.sum()


def _corrupt(truths: Assignments, segments: int, panels: int, rng: np.random.Generator) -> Assignments:
    """Copies of the truths in which `panels` parts have become empty, or took a free segment or each other's."""
    out = []
    for truth in truths:
        for _ in range(CORRUPTIONS):
            row = truth.copy()
            for part in rng.choice(len(row), panels, replace=False):
                _replace(row, int(part), segments, rng)
            out.append(row)
    return np.array(out, np.int64).reshape(len(out), truths.shape[1])


def _replace(row: NDArray[np.int64], part: int, segments: int, rng: np.random.Generator) -> None:
    choice = int(rng.integers(-1, segments))
    if choice >= 0:
        taken_by = np.flatnonzero(row == choice)
        # Two parts swap: no segment is used twice.
        row[taken_by] = row[part]
    row[part] = choice
