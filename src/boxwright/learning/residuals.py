"""What is left of a group once a box is taken out of it, as a learning problem of its own."""

from __future__ import annotations

import numpy as np

from boxwright.learning.problems import LearningProblem, no_box_gains


def with_residuals(problems: list[LearningProblem]) -> list[LearningProblem]:
    """The problems, each followed by those in which one of its boxes is taken: inference goes on with the rest."""
    out = []
    for learning in problems:
        out.append(learning)
        out.extend(_residual(learning, box) for box in range(len(learning.truths)))
    return out


def _residual(learning: LearningProblem, box: int) -> LearningProblem:
    """The problem without the segments of one true box; whatever of that box is left is right for no part."""
    taken = [int(s) for s in learning.truths[box] if s >= 0]
    kept = [s for s in range(len(learning.problem)) if s not in taken]
    others = np.arange(len(learning.truths)) != box
    truths = learning.truths[others]
    # An old number's new one; -1, "none", stays.
    renumbered = np.full(len(learning.problem) + 1, -1, np.int64)
    renumbered[kept] = np.arange(len(kept))
    truths = renumbered[truths]
    shows = (truths >= 0).any(axis=1)
    views_of_a_box = len(learning.gains) // len(learning.truths)
    views = np.repeat(others, views_of_a_box)
    gains, panels = learning.gains[views][:, :, [*kept, -1]], learning.panels[views]
    if not shows.any():
        parts = learning.truths.shape[1]
        gains, panels = no_box_gains(parts, len(kept)), np.array([float(parts)])
    return LearningProblem(
        frame=learning.frame,
        problem=learning.problem.without(taken),
        gains=gains,
        panels=panels,
        truths=truths[shows],
    )
