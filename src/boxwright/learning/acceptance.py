"""From which score on an assignment is called an object."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation import FrameScore, score_frame
from boxwright.models import LearnedWeights
from boxwright.types import Object, Truth

LOWEST_SCORE = 0.05
"""Nothing that scores less is ever an object."""

STEP = 0.05
"""Distance of the scores that are tried."""

# Made once, at import: threads that make their first decoder of a type together have crashed.
_OBJECT = msgspec.json.Decoder(Object)

FALSE_OBJECT_COST = 1.0
"""What an object where none is costs, in boxes that were understood in full."""


def choose_accept_score(
    template: _core.Template,
    learned: LearnedWeights,
    frames: list[tuple[_core.Perception, Truth, NDArray[np.uint16]]],
) -> LearnedWeights:
    """The weights with the score that does best on the frames: full accuracy less false objects' cost (eq. 15)."""
    loose = msgspec.structs.replace(learned, accept_score=LOWEST_SCORE)
    model = _core.ObjectModel(template, msgspec.json.encode(loose).decode())
    answers = [_understood(model, perception) for perception, _, _ in frames]
    best_merit, best_score = -np.inf, LOWEST_SCORE
    for score in np.arange(LOWEST_SCORE, 1.5, STEP):
        merit = 0.0
        for (objects, object_labels, part_labels), (_, truth, truth_labels) in zip(answers, frames, strict=True):
            kept, labels = _at_least(float(score), objects, object_labels)
            merit += _merit(score_frame(kept, labels, part_labels, truth, truth_labels))
        if merit > best_merit:
            best_merit, best_score = merit, float(score)
    return msgspec.structs.replace(learned, accept_score=round(best_score, 6))


def _understood(
    model: _core.ObjectModel, perception: _core.Perception
) -> tuple[tuple[Object, ...], NDArray[np.int16], NDArray[np.int16]]:
    answer = _core.understand(perception, [model])
    objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
    return objects, answer.object_labels, answer.part_labels


def _at_least(
    score: float, objects: tuple[Object, ...], object_labels: NDArray[np.int16]
) -> tuple[tuple[Object, ...], NDArray[np.int16]]:
    """The objects of at least that score; they come best first, so their numbers stay."""
    kept = tuple(o for o in objects if o.score >= score)
    return kept, np.where(object_labels < len(kept), object_labels, np.int16(-1))


def _merit(score: FrameScore) -> float:
    boxes = sum(box.full_accuracy or 0.0 for box in score.boxes)
    return boxes - FALSE_OBJECT_COST * score.false_objects
