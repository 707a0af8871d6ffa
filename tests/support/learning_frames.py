"""Simulated frames after perception, as learning takes them, made once for all tests."""

from __future__ import annotations

from functools import cache

from boxwright import _core
from boxwright.learning import SeenFrame
from boxwright.learning.problems import LearningProblem, learning_problems
from boxwright.models import load_template
from boxwright.perception import perceive
from boxwright.simulation import make_frame
from boxwright.types import Cloud

REQUESTS = (("small", 1), ("medium", 1), ("large", 1), ("carton", 1), ("small", 2), ("medium", 2))
"""Categories with their number of boxes; frame k of one seed's sequence each."""

SEED = 14


@cache
def carton() -> _core.Template:
    return load_template("carton")


@cache
def seen_frames() -> tuple[SeenFrame, ...]:
    return tuple(_seen(category, index, boxes) for index, (category, boxes) in enumerate(REQUESTS))


@cache
def problems() -> tuple[tuple[SeenFrame, LearningProblem], ...]:
    """Every group of every frame."""
    return tuple((frame, learning) for frame in seen_frames() for learning in problems_of(frame))


def problems_of(frame: SeenFrame) -> list[LearningProblem]:
    return learning_problems(frame.name, frame.perception, carton(), frame.truth, frame.truth_labels)


def _seen(category: str, index: int, boxes: int) -> SeenFrame:
    frame = make_frame(category, SEED, index, boxes=boxes)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    return SeenFrame(frame.truth.name, perceive(cloud, planes="ransac"), frame.truth, frame.labels)
