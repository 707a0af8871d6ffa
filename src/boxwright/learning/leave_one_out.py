"""How weights do on each frame when it has no part in their fit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.exact_rounds import ExactLearner, ExactProblems, fit
from boxwright.learning.learned import Learned
from boxwright.learning.likelihood import Prior
from boxwright.models.weights import LeftOut
from boxwright.parallel import ordered_map


def leave_one_out(
    learner: ExactLearner,
    problems: ExactProblems,
    names: list[str],
    learned: Learned,
    center: NDArray[np.float64],
    jobs: int,
) -> tuple[LeftOut, ...]:
    """Each frame that shows a box, judged by weights fitted to all others from the prior's `center` (terms,).

    The assignments compared and the regularizer are those of the full fit; the frame's own are not among them. The
    frame is then searched anew.
    """

    def judged(frame: int) -> LeftOut:
        others = problems.without_frame(frame).stack()
        prior = Prior(center, 1.0 / others.spread(), learned.regularizer)
        weights = fit(learner, others, prior, learned.weights)
        mine = [p for p, k in zip(problems.problems, problems.frames, strict=True) if k == frame and len(p.truths)]
        best = [float(p.correctness(p.problem.solve(weights)[0])[0]) for p in mine]
        reachable = [float(p.correctness(p.truths).max()) for p in mine]
        return LeftOut(names[frame], float(np.mean(best)), float(np.mean(np.maximum(best, reachable))))

    with_box = sorted({int(k) for p, k in zip(problems.problems, problems.frames, strict=True) if len(p.truths)})
    if len(with_box) < 2:
        raise ValueError("leave-one-out needs two frames that show a box, one to learn from and one to judge")
    return tuple(ordered_map(judged, with_box, jobs))
