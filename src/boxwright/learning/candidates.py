"""Candidate assignments to learn from: the truth, its corruptions, and what the weights so far like best."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.problems import Assignments, LearningProblem

TOP = 200
"""Candidates that the weights of a round rank highest."""

TWO_PANEL_CORRUPTIONS = 200
"""Corruptions of two panels that are drawn for each box; those of one panel are all taken."""

SHARES = {"truth": 0.1, "one panel": 0.1, "two panels": 0.1, "top": 0.7}
"""How much each kind of candidate weighs among those of one problem."""


@dataclass(frozen=True, eq=False)
class WeightedCandidates:
    """Candidates (K, parts) with their sample weights (K,), which sum to 1."""

    assignments: Assignments
    sample_weights: NDArray[np.float64]


class CandidatePool:
    """The candidates of one problem. What earlier weights liked stays in: else the fit forgets why it turned away."""

    def __init__(self, learning: LearningProblem, seed: int) -> None:
        """Equal arguments give equal candidates."""
        rng = np.random.default_rng(seed)
        segments = len(learning.problem)
        self._problem = learning.problem
        self._kinds = {
            "truth": learning.truths,
            "one panel": one_panel_corruptions(learning.truths, segments),
            "two panels": _two_panel_corruptions(learning.truths, segments, rng),
            "top": np.empty((0, learning.truths.shape[1]), np.int64),
        }

    def add_top(self, weights: NDArray[np.float64], importance: NDArray[np.float64]) -> None:
        """Adds what these weights (terms,) rank highest."""
        top = self._problem.rank(weights, importance, TOP)[0]
        self._kinds["top"] = np.unique(np.concatenate([self._kinds["top"], top]), axis=0)

    def weighted(self) -> WeightedCandidates:
        """All candidates so far."""
        kinds = {kind: rows for kind, rows in self._kinds.items() if len(rows)}
        total = sum(SHARES[kind] for kind in kinds)
        weights = [np.full(len(rows), SHARES[kind] / total / len(rows)) for kind, rows in kinds.items()]
        return WeightedCandidates(np.concatenate(list(kinds.values())), np.concatenate(weights))

    def __bool__(self) -> bool:
        return any(len(rows) for rows in self._kinds.values())


def one_panel_corruptions(truths: Assignments, segments: int) -> Assignments:
    """Every copy of a truth in which one part has become empty, or took a free segment or another part's."""
    rows = [
        _replaced(truth, part, segment)
        for truth in truths
        for part in range(truths.shape[1])
        for segment in range(-1, segments)
        if segment != truth[part]
    ]
    return _distinct(rows, truths.shape[1])


def _two_panel_corruptions(truths: Assignments, segments: int, rng: np.random.Generator) -> Assignments:
    rows = []
    for truth in truths:
        for _ in range(TWO_PANEL_CORRUPTIONS):
            row = truth
            for part in rng.choice(len(truth), 2, replace=False):
                row = _replaced(row, int(part), int(rng.integers(-1, segments)))
            rows.append(row)
    return _distinct(rows, truths.shape[1])


def _replaced(row: NDArray[np.int64], part: int, segment: int) -> NDArray[np.int64]:
    out = row.copy()
    if segment >= 0:
        # Two parts swap: no segment is used twice.
        out[row == segment] = row[part]
    out[part] = segment
    return out


def _distinct(rows: list[NDArray[np.int64]], parts: int) -> Assignments:
    return np.unique(np.array(rows, np.int64).reshape(len(rows), parts), axis=0)
