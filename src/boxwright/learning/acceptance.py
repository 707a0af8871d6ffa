"""From which score on an assignment is called an object."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np

from boxwright import _core
from boxwright.evaluation import FrameScore, score_frame
from boxwright.learning.seen import SeenFrame
from boxwright.learning.understood import Understood, understand_all
from boxwright.models import LearnedWeights

FALSE_OBJECT_COST = 1.0
"""What an object where none is costs, in boxes that were understood in full."""


RIDGE_SCORES = tuple(float(score) for score in np.arange(0.05, 1.5, 0.05))
"""Scores that are tried as the least of an object: the paper's scores predict correctness."""


def choose_accept_score(
    template: _core.Template, learned: LearnedWeights, frames: Sequence[SeenFrame], jobs: int = 1
) -> LearnedWeights:
    """The paper's weights with the score that does best on the frames under the staged search."""
    loose = msgspec.structs.replace(learned, accept_score=RIDGE_SCORES[0])
    understood = understand_all(template, loose, frames, {}, jobs)
    return msgspec.structs.replace(learned, accept_score=best_accept_score(understood, RIDGE_SCORES))


def best_accept_score(understood: Sequence[Understood], scores: Sequence[float]) -> float:
    """Of the scores that are tried the one that does best: full accuracy less false objects' cost (eq. 15).

    The frames must have been understood with the lowest of the scores; of equals the first wins.
    """
    merits = [sum(_merit(one.at_least(score)) for one in understood) for score in scores]
    return round(float(scores[int(np.argmax(merits))]), 6)


def _merit(understood: Understood) -> float:
    score: FrameScore = score_frame(
        understood.objects,
        understood.object_labels,
        understood.part_labels,
        understood.frame.truth,
        understood.frame.truth_labels,
    )
    boxes = sum(box.full_accuracy or 0.0 for box in score.boxes)
    return boxes - FALSE_OBJECT_COST * score.false_objects
