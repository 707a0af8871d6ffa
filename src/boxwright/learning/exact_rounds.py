"""Learners on exact inference: pools that grow by what the exact search ranks highest, and fits to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.candidates import one_panel_corruptions
from boxwright.learning.learned import Learned
from boxwright.learning.likelihood import Prior, fit_likelihood, loss
from boxwright.learning.margin import LossAugmented, fit_margin
from boxwright.learning.pools import TIE, AssignmentPool
from boxwright.learning.problems import LearningProblem
from boxwright.learning.residuals import with_residuals
from boxwright.learning.stacks import Stack
from boxwright.parallel import ordered_map

Array = NDArray[np.float64]
ExactLearner = Literal["margin", "likelihood"]

ROUNDS = 4
"""How often pools grow after the first fit."""

LISTED = {"margin": 20, "likelihood": 60}
"""Assignments that the search adds to each pool in a round."""

STRENGTHS = {"margin": (0.3, 0.1, 0.03, 0.01), "likelihood": (0.1, 0.01, 0.001, 0.0001)}
"""How strongly weights are drawn towards the prior: what is tried, strongest first."""

FOLDS = 5
"""Parts of the frames that are held out in turn to choose the strength."""

LEAST_SEGMENTS = 3
"""Groups with fewer segments hold no object and teach nothing."""


@dataclass(frozen=True, eq=False)
class ExactProblems:
    """The problems of all frames, those with a box taken included; `frames` (P,) numbers each problem's frame."""

    template: _core.Template
    problems: list[LearningProblem]
    frames: NDArray[np.int64]
    pools: list[AssignmentPool] = field(default_factory=list)

    @staticmethod
    def of(template: _core.Template, by_frame: Sequence[Sequence[LearningProblem]]) -> ExactProblems:
        """Of each frame's problems."""
        numbered = [(k, p) for k, problems in enumerate(by_frame) for p in with_residuals(list(problems))]
        numbered = [(k, p) for k, p in numbered if len(p.problem) >= LEAST_SEGMENTS]
        if not any(len(p.truths) for _, p in numbered):
            raise ValueError("no frame shows a box of which perception found a panel; such frames are needed")
        made = ExactProblems(template, [p for _, p in numbered], np.array([k for k, _ in numbered], np.int64))
        for learning in made.problems:
            pool = AssignmentPool(learning, template)
            pool.add(one_panel_corruptions(learning.truths, len(learning.problem)))
            made.pools.append(pool)
        return made

    def without_frame(self, frame: int) -> ExactProblems:
        """All but one frame's."""
        kept = np.flatnonzero(self.frames != frame)
        return ExactProblems(
            self.template, [self.problems[i] for i in kept], self.frames[kept], [self.pools[i] for i in kept]
        )

    def stack(self, chosen: NDArray[np.bool_] | None = None) -> Stack:
        """The pools of the chosen problems (P,); by default of all. Each problem weighs the same."""
        which = range(len(self.pools)) if chosen is None else np.flatnonzero(chosen)
        return Stack.of([self.pools[i] for i in which], np.ones(len(which)))


def fit(learner: ExactLearner, stack: Stack, prior: Prior, start: Array) -> Array:
    """The learner's weights (terms,) for these pools."""
    fitted = fit_margin if learner == "margin" else fit_likelihood
    return fitted(stack, prior, start)


def grow(learner: ExactLearner, problems: ExactProblems, weights: Array, jobs: int) -> int:
    """Adds to each pool what the exact search ranks highest under the weights; how many were new."""

    def ranked(learning: LearningProblem) -> NDArray[np.int64]:
        if learner == "margin":
            return LossAugmented(learning, problems.template).worst(weights, LISTED[learner])
        return learning.problem.solve(weights, LISTED[learner])[0]

    listed = ordered_map(ranked, problems.problems, jobs)
    return sum(pool.add(rows) for pool, rows in zip(problems.pools, listed, strict=True))


def learn_exact(
    learner: ExactLearner,
    problems: ExactProblems,
    center: Array,
    *,
    jobs: int,
    progress: Callable[[str], None],
) -> Learned:
    """Weights by the learner, drawn towards `center` (terms,) as strongly as held-out frames want it.

    The pools grow under a strength in the middle first, so that the choice sees what weights get wrong.
    """
    strengths = STRENGTHS[learner]
    unit = 1.0 / problems.stack().spread()
    weights = center
    strength = strengths[len(strengths) // 2]
    for number in range(ROUNDS):
        weights = fit(learner, problems.stack(), Prior(center, unit, strength), weights)
        count = grow(learner, problems, weights, jobs)
        progress(f"round {number + 1}: {count} new assignments")
        if number == ROUNDS // 2 - 1:
            strength, _ = choose_strength(learner, problems, center, unit, weights)
            progress(f"strength {strength:g}")
    stack = problems.stack()
    weights = fit(learner, stack, Prior(center, unit, strength), weights)
    _, held_out = choose_strength(learner, problems, center, unit, weights, (strength,))
    with_box = np.array([len(p.truths) > 0 for p in problems.problems])
    best = stack.best_correctness(weights)
    reachable = np.array([pool.correctness.max() for pool in problems.pools])
    return Learned(
        weights=weights,
        importance=np.abs(weights) / unit,
        candidates=len(stack.features),
        regularizer=strength,
        fit_error=_error(learner, stack, weights),
        held_out_error=held_out,
        rank_accuracy=float(np.mean(best[with_box] >= reachable[with_box] - TIE)),
    )


def choose_strength(
    learner: ExactLearner,
    problems: ExactProblems,
    center: Array,
    unit: Array,
    start: Array,
    strengths: Sequence[float] | None = None,
) -> tuple[float, float]:
    """The strength of the least held-out error over folds of frames, and that error; the strongest of equals."""
    strengths = STRENGTHS[learner] if strengths is None else strengths
    fold = problems.frames % min(FOLDS, int(problems.frames.max()) + 1)
    errors = np.zeros(len(strengths))
    for held in np.unique(fold):
        rest, out = problems.stack(fold != held), problems.stack(fold == held)
        weights = start
        for k, strength in enumerate(strengths):
            weights = fit(learner, rest, Prior(center, unit, strength), weights)
            errors[k] += _error(learner, out, weights) * float(np.mean(fold == held))
    return strengths[int(np.argmin(errors))], float(errors.min())


def _error(learner: ExactLearner, stack: Stack, weights: Array) -> float:
    """Mean loss of the learner: of correctness for the margin, -log probability for the likelihood."""
    if learner == "likelihood":
        return float(stack.shares @ loss(stack, weights))
    best = np.maximum.reduceat(stack.correctness, stack.starts)
    return float(stack.shares @ (best - stack.best_correctness(weights)))
