"""The paper's normal equations on candidates that the search itself proposes, round by round."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.candidates import CandidatePool
from boxwright.learning.learned import Learned
from boxwright.learning.problems import LearningProblem
from boxwright.learning.ridge import FrameEquations, RidgeFit, fit_ridge
from boxwright.parallel import ordered_map

ROUNDS = 8
"""How often weights are fitted, each time with the candidates added that the last ones liked best."""

EMPTY_GROUPS_SHARE = 0.15
"""What the groups of a frame in which no box shows weigh together, beside those with a box; a frame weighs 1."""


@dataclass(frozen=True, eq=False)
class _Round:
    """Weights of one round: the better they rank the training boxes' assignments, the better the round."""

    fit: RidgeFit
    importance: NDArray[np.float64]
    candidates: int
    mean_correctness: float
    rank_accuracy: float


def learn_ridge(
    template: _core.Template,
    by_frame: list[list[LearningProblem]],
    *,
    jobs: int,
    progress: Callable[[str], None],
) -> Learned:
    """The weights of the round whose best assignments are most correct. Raises ValueError below two frames."""
    pools = [[CandidatePool(learning, seed=k) for k, learning in enumerate(problems)] for problems in by_frame]
    terms = len(template.feature_names) + len(template.relation_names)
    weights, importance = np.ones(terms), np.ones(terms)
    rounds = []
    for number in range(ROUNDS):
        _add_top(pools, weights, importance, jobs)
        equations, count = _equations(by_frame, pools)
        fit = fit_ridge(equations)
        weights, importance = fit.weights, np.abs(fit.weights) * fit.scale
        rounds.append(_judged(fit, importance, count, by_frame, jobs))
        progress(
            f"round {number + 1}: {count} candidates, held-out error {fit.held_out_error:.4f}, "
            f"mean correctness of the best {rounds[-1].mean_correctness:.3f}"
        )
    best = max(rounds, key=lambda r: r.mean_correctness)
    return Learned(
        weights=best.fit.weights,
        importance=best.importance,
        candidates=best.candidates,
        regularizer=best.fit.regularizer,
        fit_error=best.fit.fit_error,
        held_out_error=best.fit.held_out_error,
        rank_accuracy=best.rank_accuracy,
    )


def _add_top(
    pools: list[list[CandidatePool]], weights: NDArray[np.float64], importance: NDArray[np.float64], jobs: int
) -> None:
    flat = [pool for row in pools for pool in row]
    for _ in ordered_map(lambda pool: pool.add_top(weights, importance), flat, jobs):
        pass


def _equations(
    by_frame: list[list[LearningProblem]], pools: list[list[CandidatePool]]
) -> tuple[list[FrameEquations], int]:
    """Each frame's share of the normal equations, and how many candidates there are."""
    equations, count = [], 0
    for problems, row in zip(by_frame, pools, strict=True):
        features, correctness, sample_weights = [], [], []
        for learning, pool, share in zip(problems, row, _shares(problems), strict=True):
            if pool:
                candidates = pool.weighted()
                features.append(learning.problem.features(candidates.assignments))
                correctness.append(learning.correctness(candidates.assignments))
                sample_weights.append(candidates.sample_weights * share)
                count += len(candidates.assignments)
        if features:
            stacked = (np.concatenate(features), np.concatenate(correctness), np.concatenate(sample_weights))
            equations.append(FrameEquations.of(*stacked))
    return equations, count


def _shares(problems: list[LearningProblem]) -> list[float]:
    """What each problem of a frame weighs."""
    with_box = sum(len(learning.truths) > 0 for learning in problems)
    without = len(problems) - with_box
    return [
        (1.0 - EMPTY_GROUPS_SHARE) / with_box if len(learning.truths) else EMPTY_GROUPS_SHARE / without
        for learning in problems
    ]


def _judged(
    fit: RidgeFit, importance: NDArray[np.float64], count: int, by_frame: list[list[LearningProblem]], jobs: int
) -> _Round:
    """How correct the best ranked assignment of each group with a box is, and how often none is known to be better."""
    problems = [learning for problems in by_frame for learning in problems if len(learning.truths)]

    def best_and_reachable(learning: LearningProblem) -> tuple[float, float]:
        ranked = learning.correctness(learning.problem.rank(fit.weights, importance, 1)[0])[0]
        return float(ranked), max(float(ranked), float(learning.correctness(learning.truths).max()))

    pairs = np.array(list(ordered_map(best_and_reachable, problems, jobs))).reshape(len(problems), 2)
    first = pairs[:, 0] >= pairs[:, 1] - 1e-9
    return _Round(
        fit=fit,
        importance=importance,
        candidates=count,
        mean_correctness=float(pairs[:, 0].mean()) if len(problems) else 0.0,
        rank_accuracy=float(first.mean()) if len(problems) else 0.0,
    )
