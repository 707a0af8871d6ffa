"""From labelled frames to weights, by the paper's normal equations on candidates that the search itself proposes."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.acceptance import choose_accept_score
from boxwright.learning.candidates import candidates
from boxwright.learning.problems import LearningProblem, learning_problems
from boxwright.learning.ridge import FrameEquations, RidgeFit, fit_ridge
from boxwright.models import LearnedWeights
from boxwright.models.weights import TrainingReport
from boxwright.types import Truth

ROUNDS = 3
"""How often candidates are made anew with the weights learned so far."""


@dataclass(frozen=True, eq=False)
class SeenFrame:
    """A labelled frame after perception. `truth_labels` (N,): index of the true part + 1, 0 for none."""

    name: str
    perception: _core.Perception
    truth: Truth
    truth_labels: NDArray[np.uint16]


def train(
    template: _core.Template,
    frames: Iterable[SeenFrame],
    *,
    command: str,
    progress: Callable[[str], None] = lambda message: None,
) -> LearnedWeights:
    """Learns the weights of a template from labelled frames; equal frames give equal weights.

    `command` is written into the weights, so that they can be made again. Raises ValueError with fewer than two frames.
    """
    frames = list(frames)
    by_frame = [learning_problems(f.name, f.perception, template, f.truth, f.truth_labels) for f in frames]
    terms = len(template.feature_names) + len(template.relation_names)
    weights, importance = np.ones(terms), np.ones(terms)
    pools: list[list[NDArray[np.int64]]] = [[np.empty((0, len(template.parts)), np.int64) for _ in p] for p in by_frame]
    for round_number in range(1, ROUNDS + 1):
        equations, count = _equations(by_frame, pools, weights, importance, round_number)
        fit = fit_ridge(equations)
        weights, importance = fit.weights, np.abs(fit.weights) * fit.scale
        progress(f"round {round_number}: {count} candidates, held-out error {fit.held_out_error:.4f}")
    return _learned(template, frames, by_frame, fit, importance, command, count)


def _equations(
    by_frame: list[list[LearningProblem]],
    pools: list[list[NDArray[np.int64]]],
    weights: NDArray[np.float64],
    importance: NDArray[np.float64],
    seed: int,
) -> tuple[list[FrameEquations], int]:
    """Each frame's share of the normal equations, and how many candidates there are; a frame weighs 1."""
    equations, count = [], 0
    for problems, pool in zip(by_frame, pools, strict=True):
        features, correctness, sample_weights = [], [], []
        for k, learning in enumerate(problems):
            rows, row_weights = candidates(learning, weights, importance, seed)
            # What earlier weights liked stays in: else the fit forgets why it turned away from it.
            pool[k] = np.unique(np.concatenate([pool[k], rows]), axis=0)
            older = pool[k]
            for assignments, share in ((rows, row_weights), (older, np.full(len(older), 1.0 / len(older)))):
                features.append(learning.problem.features(assignments))
                correctness.append(learning.correctness(assignments))
                sample_weights.append(share / (2.0 * len(problems)))
            count += len(older)
        if features:
            stacked = (np.concatenate(features), np.concatenate(correctness), np.concatenate(sample_weights))
            equations.append(FrameEquations.of(*stacked))
    return equations, count


def _learned(
    template: _core.Template,
    frames: list[SeenFrame],
    by_frame: list[list[LearningProblem]],
    fit: RidgeFit,
    importance: NDArray[np.float64],
    command: str,
    count: int,
) -> LearnedWeights:
    names = template.feature_names + template.relation_names
    problems = [learning for problems in by_frame for learning in problems if len(learning.truths)]
    ranked_first = [_best_comes_first(learning, fit.weights, importance) for learning in problems]
    learned = LearnedWeights(
        template=template.name,
        weights=dict(zip(names, fit.weights.tolist(), strict=True)),
        importance=dict(zip(names, importance.tolist(), strict=True)),
        accept_score=0.0,
        training=TrainingReport(
            command=command,
            frames=len(frames),
            candidates=count,
            regularizer=fit.regularizer,
            fit_error=fit.fit_error,
            held_out_error=fit.held_out_error,
            rank_accuracy=float(np.mean(ranked_first)) if ranked_first else 0.0,
        ),
    )
    return choose_accept_score(template, learned, [(f.perception, f.truth, f.truth_labels) for f in frames])


def _best_comes_first(learning: LearningProblem, weights: NDArray[np.float64], importance: NDArray[np.float64]) -> bool:
    """Whether the candidate that scores highest is as correct as the most correct one that is known."""
    ranked = learning.problem.rank(weights, importance, 1)[0]
    pool = np.concatenate([learning.truths, candidates(learning, weights, importance, 0)[0]])
    return bool(learning.correctness(ranked)[0] >= learning.correctness(pool).max() - 1e-9)
