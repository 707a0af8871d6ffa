"""Frames understood by weights that were fitted without them: what these get right tells what new frames will."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.learning.exact_rounds import FOLDS, ExactLearner, ExactProblems, fit
from boxwright.learning.learned import Learned
from boxwright.learning.likelihood import Prior
from boxwright.learning.seen import SeenFrame
from boxwright.learning.understood import Understood, understand_all
from boxwright.models import LearnedWeights


def understand_held_out(
    learner: ExactLearner,
    problems: ExactProblems,
    frames: Sequence[SeenFrame],
    learned: Learned,
    weights: LearnedWeights,
    center: NDArray[np.float64],
    jobs: int,
) -> list[Understood]:
    """Each frame by weights fitted to the other folds' frames; temperature and least score are those of `weights`."""
    names = problems.template.feature_names + problems.template.relation_names
    folds = min(FOLDS, len(frames))
    out: list[Understood] = []
    for held in range(folds):
        rest = problems.stack(problems.frames % folds != held)
        prior = Prior(center, 1.0 / rest.spread(), learned.regularizer)
        fitted = fit(learner, rest, prior, learned.weights)
        own = msgspec.structs.replace(weights, weights=dict(zip(names, fitted.tolist(), strict=True)))
        mine = [frame for number, frame in enumerate(frames) if number % folds == held]
        out += understand_all(problems.template, own, mine, {"search": "exact"}, jobs, with_rays=True)
    return out
