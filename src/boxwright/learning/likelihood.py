"""Maximum likelihood: weights under which P(G) of eq. 49, at temperature 1, is greatest for the truths."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.stacks import Stack

Array = NDArray[np.float64]

NEWTON_STEPS = 60
"""At most; a fit from a near start takes about ten."""

HALVINGS = 20
"""How often a step that does not help is halved before the fit ends."""

TOLERANCE = 1e-9
"""The fit ends where a step lowers the loss by no more."""


@dataclass(frozen=True, eq=False)
class Prior:
    """Weights are drawn towards `center`, by `strength` times half the square of their distance over `unit`."""

    center: Array
    unit: Array
    strength: float

    def penalty(self, weights: Array) -> float:
        """What a fit pays for these weights (terms,)."""
        return 0.5 * self.strength * float(np.sum(((weights - self.center) / self.unit) ** 2))


def loss(stack: Stack, weights: Array) -> Array:
    """(P,) -log of the probability of each problem's truths among its pool (eq. 61)."""
    scores = stack.features @ weights + stack.log_copies
    out: Array = _log_sums(scores, stack) - _log_sums(np.where(stack.is_truth, scores, -np.inf), stack)
    return out


def fit_likelihood(stack: Stack, prior: Prior, start: Array) -> Array:
    """The weights (terms,) of the least loss with the prior's penalty, from `start`, by Newton's method with halving.

    Truths that tie are one: the curvature of their own sum is left out, so every step goes downhill (eq. 62).
    """
    weights, now = start, _total(stack, prior, start)
    for _ in range(NEWTON_STEPS):
        gradient, curvature = _derivatives(stack, prior, weights)
        step = np.linalg.solve(curvature, gradient)
        for _ in range(HALVINGS):
            trial = weights - step
            after = _total(stack, prior, trial)
            if after < now:
                break
            step = step / 2.0
        else:
            return weights
        weights, gained, now = trial, now - after, after
        if gained <= TOLERANCE:
            break
    return weights


def _total(stack: Stack, prior: Prior, weights: Array) -> float:
    return float(stack.shares @ loss(stack, weights)) + prior.penalty(weights)


def _derivatives(stack: Stack, prior: Prior, weights: Array) -> tuple[Array, Array]:
    scores = stack.features @ weights + stack.log_copies
    chosen = _probabilities(scores, stack)
    right = _probabilities(np.where(stack.is_truth, scores, -np.inf), stack)
    shares = np.repeat(stack.shares, np.diff([*stack.starts, len(stack.features)]))
    means = np.add.reduceat(stack.features * chosen[:, None], stack.starts, axis=0)
    pull = prior.strength / prior.unit**2
    gradient = ((chosen - right) * shares) @ stack.features + pull * (weights - prior.center)
    moment = (stack.features * (chosen * shares)[:, None]).T @ stack.features
    curvature = moment - (means * stack.shares[:, None]).T @ means + np.diag(pull)
    return gradient, curvature


def _log_sums(scores: Array, stack: Stack) -> Array:
    highest = np.maximum.reduceat(scores, stack.starts)
    counts = np.diff([*stack.starts, len(scores)])
    sums: Array = np.add.reduceat(np.exp(scores - np.repeat(highest, counts)), stack.starts)
    out: Array = highest + np.log(sums)
    return out


def _probabilities(scores: Array, stack: Stack) -> Array:
    counts = np.diff([*stack.starts, len(scores)])
    out: Array = np.exp(scores - np.repeat(_log_sums(scores, stack), counts))
    return out
