"""Score a method on a scene set, and keep the result as a file to compare later."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from os import PathLike
from pathlib import Path
from typing import Literal

import msgspec

from boxwright.evaluation.frames import score_frame
from boxwright.evaluation.scores import FrameScore
from boxwright.evaluation.sets import LabelledFrame
from boxwright.evaluation.summary import Summary, summarize
from boxwright.io.decoding import load_json, save_json
from boxwright.io.labels import PointLabels
from boxwright.types import Object


class Answer(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """What a method says of one cloud: its objects, and for each point which of them it belongs to."""

    objects: tuple[Object, ...]
    labels: PointLabels


class Evaluation(msgspec.Struct, frozen=True, kw_only=True):
    """A method's figures on a set: the summary, and the score of each frame that it comes from."""

    format: Literal["boxwright.evaluation"]
    version: Literal[1]
    method: str
    set: str
    summary: Summary
    frames: tuple[FrameScore, ...]


def score_set(frames: Iterable[LabelledFrame], answer: Callable[[Path], Answer]) -> tuple[FrameScore, ...]:
    """The score of each frame, in order; `answer` is given the path of the frame's cloud. Its errors pass through."""
    return tuple(score_answer(frame, answer(frame.cloud_path)) for frame in frames)


def score_answer(frame: LabelledFrame, answer: Answer) -> FrameScore:
    """The score of one frame. Raises ValueError when the answer's labels do not fit the frame's."""
    return score_frame(answer.objects, answer.labels.object, answer.labels.part, frame.truth, frame.labels)


def make_evaluation(method: str, set_name: str, frames: Iterable[FrameScore]) -> Evaluation:
    """Scores with their summary, ready to be written."""
    scores = tuple(frames)
    return Evaluation(
        format="boxwright.evaluation",
        version=1,
        method=method,
        set=set_name,
        summary=summarize(scores),
        frames=scores,
    )


def load_evaluation(path: str | PathLike[str]) -> Evaluation:
    """Read an evaluation. Raises OSError when it cannot be read, ValueError naming file and key when it is wrong."""
    return load_json(path, Evaluation)


def save_evaluation(evaluation: Evaluation, path: str | PathLike[str]) -> None:
    """Write an evaluation; equal ones give equal bytes. Raises OSError when it cannot be written."""
    save_json(evaluation, path)
