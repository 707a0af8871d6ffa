"""Largest margin: a structured support vector machine by block-coordinate Frank-Wolfe steps.

Lacoste-Julien, Jaggi, Schmidt and Pletscher, "Block-coordinate Frank-Wolfe optimization for structural SVMs", 2013.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.likelihood import Prior
from boxwright.learning.problems import Assignments, LearningProblem
from boxwright.learning.stacks import Stack

Array = NDArray[np.float64]

PASSES = 60
"""At most, over all problems in their order."""

GAP = 1e-3
"""The fit ends where the duality gap is no more, in units of correctness."""


def fit_margin(stack: Stack, prior: Prior, start: Array) -> Array:
    """The weights (terms,) that hold each truth above the other assignments of its pool by their loss (eq. 63).

    Of several truths the one that `start` ranks highest is held up. Problems come in their order: no draw is made.
    """
    scores = stack.features @ start
    rows = [stack.rows(i) for i in range(len(stack))]
    differences, losses = [], []
    for r in rows:
        held = int(np.argmax(np.where(stack.is_truth[r], scores[r], -np.inf)))
        differences.append((stack.features[r][held] - stack.features[r]) * prior.unit)
        losses.append(stack.correctness[r].max() - stack.correctness[r])
    return prior.center + prior.unit * _frank_wolfe(differences, losses, stack.shares, prior)


def _frank_wolfe(differences: list[Array], losses: list[Array], shares: Array, prior: Prior) -> Array:
    """The scaled distance from the prior's centre; each problem holds its own part of it and of the loss."""
    terms = len(prior.center)
    # The prior's centre already wins a part of each margin.
    owed = [loss - d @ (prior.center / prior.unit) for d, loss in zip(differences, losses, strict=True)]
    own, own_loss = np.zeros((len(differences), terms)), np.zeros(len(differences))
    total = np.zeros(terms)
    for _ in range(PASSES):
        gap = 0.0
        for i, (d, owed_i) in enumerate(zip(differences, owed, strict=True)):
            worst = int(np.argmax(owed_i - d @ total))
            corner, corner_loss = shares[i] / prior.strength * d[worst], shares[i] * float(owed_i[worst])
            away = own[i] - corner
            local = prior.strength * float(away @ total) - own_loss[i] + corner_loss
            gap += local
            length = prior.strength * float(away @ away)
            if length > 0.0:
                step = min(max(local / length, 0.0), 1.0)
                own_loss[i] += step * (corner_loss - own_loss[i])
                total = total - step * away
                own[i] -= step * away
        if gap <= GAP:
            break
    return total


class LossAugmented:
    """A problem whose score has the loss added: what it ranks highest breaks the margin most.

    The loss here counts a segment as right where it is right for any part of the same orbit under the symmetries, so
    that the sum stays symmetric and the exact search stays exact; never more than the true loss.
    """

    def __init__(self, learning: LearningProblem, template: _core.Template) -> None:
        orbits = _orbits(template)
        best_view = learning.gains.max(axis=0)[:, :-1]
        by_orbit = np.array([best_view[orbit].max(axis=0) for orbit in orbits])
        self._features = len(template.feature_names)
        self._orbits = len(orbits)
        self._problem = learning.problem.with_features(orbits, -by_orbit / learning.panels.max())

    def worst(self, weights: Array, most: int) -> Assignments:
        """The assignments (K, parts) of the highest score plus loss under `weights` (terms,)."""
        weighted = np.insert(weights, self._features, np.ones(self._orbits))
        return self._problem.solve(weighted, most)[0]


def _orbits(template: _core.Template) -> list[list[int]]:
    """Parts that the symmetries carry into each other."""
    found: list[list[int]] = []
    for part in range(len(template.parts)):
        if not any(part in orbit for orbit in found):
            found.append(sorted({symmetry[part] for symmetry in template.symmetries}))
    return found
