"""Assignments of one problem that fits on exact inference compare: the truth, and what weights so far rank highest."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.problems import Assignments, LearningProblem

Array = NDArray[np.float64]

TIE = 1e-9
"""Correctness nearer than this is the same."""


class AssignmentPool:
    """Assignments of one problem, distinct up to the template's symmetries, with their features and correctness.

    The empty assignment, the truths and the truths with one part emptied are in from the start. What enters stays:
    sums over the pool only grow towards the sums over all assignments.
    """

    def __init__(self, learning: LearningProblem, template: _core.Template) -> None:
        self.learning = learning
        self._symmetries = np.array(template.symmetries, np.int64)
        # `symmetries[k][p]` takes part p's segment: the copy's part q holds what stands at the inverse.
        self._sources = np.argsort(self._symmetries, axis=1)
        self._known: dict[bytes, int] = {}
        parts, terms = len(template.parts), len(template.feature_names) + len(template.relation_names)
        self.features: Array = np.empty((0, terms))
        """(K, terms) f(G) of eq. 1."""
        self.correctness: Array = np.empty(0)
        """(K,) y(G) of eq. 11."""
        self.log_copies: Array = np.empty(0)
        """(K,) logarithm of how many different copies the symmetries make of each."""
        self.add(np.concatenate([np.full((1, parts), -1, np.int64), learning.truths, _emptied(learning.truths)]))

    def __len__(self) -> int:
        return len(self.correctness)

    def add(self, assignments: Assignments) -> int:
        """Adds those (K, parts) that are new; how many they were."""
        fresh, copies = [], []
        for row in assignments:
            images = row[self._sources]
            distinct = np.unique(images, axis=0)
            key = distinct[-1].tobytes()
            if key not in self._known:
                self._known[key] = len(self._known)
                fresh.append(row)
                copies.append(len(distinct))
        if fresh:
            rows = np.array(fresh, np.int64)
            self.features = np.concatenate([self.features, self.learning.problem.features(rows)])
            self.correctness = np.concatenate([self.correctness, self.learning.correctness(rows)])
            self.log_copies = np.concatenate([self.log_copies, np.log(np.array(copies, np.float64))])
        return len(fresh)

    def most_correct(self) -> NDArray[np.bool_]:
        """(K,) which are as correct as any: the truth, as far as perception found it."""
        best: NDArray[np.bool_] = self.correctness >= self.correctness.max() - TIE
        return best


def _emptied(truths: Assignments) -> Assignments:
    """Every copy of a truth in which one part has become empty."""
    rows = []
    for truth in truths:
        for part in np.flatnonzero(truth >= 0):
            row = truth.copy()
            row[part] = -1
            rows.append(row)
    return np.array(rows, np.int64).reshape(len(rows), truths.shape[1])
