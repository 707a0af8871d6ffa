"""From labelled frames to weights, by one of the learners."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.acceptance import best_accept_score, choose_accept_score
from boxwright.learning.exact_rounds import ExactLearner, ExactProblems, learn_exact
from boxwright.learning.held_out import understand_held_out
from boxwright.learning.learned import Learned
from boxwright.learning.leave_one_out import leave_one_out
from boxwright.learning.part_calibration import fit_calibration, part_verdicts
from boxwright.learning.problems import learning_problems
from boxwright.learning.ridge_rounds import learn_ridge
from boxwright.learning.seen import SeenFrame
from boxwright.learning.temperature import fit_temperature
from boxwright.learning.understood import understand_all
from boxwright.models import LearnedWeights
from boxwright.models.weights import TrainingReport

Learner = Literal["ridge", "margin", "likelihood"]

EXACT_SCORES = tuple(float(score) for score in np.arange(-3.0, 15.5, 0.5))
"""The same for the learners on exact inference, in temperatures: logarithms of odds against the empty assignment."""


def train(
    template: _core.Template,
    frames: Iterable[SeenFrame],
    *,
    command: str,
    learner: Learner = "ridge",
    prior: LearnedWeights | None = None,
    with_leave_one_out: bool = False,
    jobs: int = 1,
    progress: Callable[[str], None] = lambda message: None,
) -> LearnedWeights:
    """Learns the weights of a template from labelled frames; equal frames give equal weights.

    `learner`: "ridge" is the paper's; "margin" and "likelihood" learn on exact inference, and calibrate probabilities.
    They are drawn towards the weights of `prior`, of this template or of a similar one: terms of one name are one term.
    `with_leave_one_out` has them report each frame judged by weights fitted without it.
    `command` is written into the weights, so that they can be made again; `jobs` threads search. Raises ValueError
    with fewer than two frames, and for a prior that shares no term.
    """
    frames = list(frames)
    if len(frames) < 2:
        raise ValueError(f"{len(frames)} frames to learn from; at least 2 are needed, since each is held out in turn")
    by_frame = [learning_problems(f.name, f.perception, template, f.truth, f.truth_labels) for f in frames]
    if learner == "ridge":
        if prior is not None or with_leave_one_out:
            raise ValueError("learner ridge knows no prior and no leave-one-out report; margin and likelihood do")
        ridge = learn_ridge(template, by_frame, jobs=jobs, progress=progress)
        weights = _as_weights(template, ridge, learner, command, len(frames), 0.0, None)
        return choose_accept_score(template, weights, frames, jobs)
    problems = ExactProblems.of(template, by_frame)
    center = prior_center(template, prior)
    learned = learn_exact(learner, problems, center, jobs=jobs, progress=progress)
    weights = _calibrated(template, learned, problems, frames, learner, center, command, jobs)
    if not with_leave_one_out or weights.training is None:
        return weights
    left_out = leave_one_out(learner, problems, [f.name for f in frames], learned, center, jobs)
    return msgspec.structs.replace(weights, training=msgspec.structs.replace(weights.training, left_out=left_out))


def prior_center(template: _core.Template, prior: LearnedWeights | None) -> NDArray[np.float64]:
    """(terms,) the prior's weights by name, 0 for terms that it lacks. Raises ValueError where it shares no term."""
    names = template.feature_names + template.relation_names
    if prior is None:
        return np.zeros(len(names))
    if not set(names) & set(prior.weights):
        raise ValueError(
            f"the prior's weights, of {prior.template!r}, share no feature or relation with {template.name!r};"
            " name weights of a similar template"
        )
    return np.array([prior.weights.get(name, 0.0) for name in names])


def _calibrated(
    template: _core.Template,
    learned: Learned,
    problems: ExactProblems,
    frames: Sequence[SeenFrame],
    learner: ExactLearner,
    center: NDArray[np.float64],
    command: str,
    jobs: int,
) -> LearnedWeights:
    """The weights with temperature, least score of an object, and the line from marginals to probabilities."""
    temperature = fit_temperature(problems.stack(), learned.weights)
    scores = [score * temperature for score in EXACT_SCORES]
    loose = _as_weights(template, learned, learner, command, len(frames), scores[0], temperature)
    understood = understand_all(template, loose, frames, {"search": "exact"}, jobs)
    accept_score = best_accept_score(understood, scores)
    chosen = msgspec.structs.replace(loose, accept_score=accept_score)
    # The line is fitted to frames that the weights do not know: what they know they get right too often.
    held_out = understand_held_out(learner, problems, frames, learned, chosen, center, jobs)
    verdicts = [verdict for one in held_out for verdict in part_verdicts(one)]
    return msgspec.structs.replace(chosen, calibration=fit_calibration(verdicts))


def _as_weights(
    template: _core.Template,
    learned: Learned,
    learner: Learner,
    command: str,
    frames: int,
    accept_score: float,
    temperature: float | None,
) -> LearnedWeights:
    names = template.feature_names + template.relation_names
    return LearnedWeights(
        template=template.name,
        weights=dict(zip(names, learned.weights.tolist(), strict=True)),
        importance=dict(zip(names, learned.importance.tolist(), strict=True)),
        accept_score=accept_score,
        temperature=temperature,
        training=TrainingReport(
            command=command,
            learner=learner,
            frames=frames,
            candidates=learned.candidates,
            regularizer=learned.regularizer,
            fit_error=learned.fit_error,
            held_out_error=learned.held_out_error,
            rank_accuracy=learned.rank_accuracy,
        ),
    )
