"""What the searches are measured on: random tables, and features of simulated frames under the shipped weights."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.perception import perceive
from boxwright.simulation import CATEGORIES, make_frame
from boxwright.types import Cloud

FINE = {"min_segment_points": 60, "min_cluster_points": 60, "min_segment_area_m2": 0.0003}
"""Perception that keeps every scrap: clutter for the search."""

Measured = tuple[_core.Problem, Callable[[], _core.Problem]]
"""A problem, and what measures its features anew."""


def random_problems(template: _core.Template, segments: int, count: int, seed: int) -> Iterator[_core.Problem]:
    """Every value even in -0.5 .. 0.5; relations do not tell first from second, so that the symmetries hold."""
    rng = np.random.default_rng(seed)
    features, relations = len(template.feature_names), len(template.relation_names)
    for _ in range(count):
        tied = np.triu(rng.uniform(-0.5, 0.5, (relations, segments, segments)), 1)
        own = rng.uniform(-0.5, 0.5, (features, segments))
        yield _core.Problem.of_values(template, own, tied + tied.transpose(0, 2, 1))


def simulated_problems(template: _core.Template, segments: int, count: int, seed: int) -> Iterator[Measured]:
    """The first group of simulated frames, filled up with other segments of the frame to `segments`.

    Frames that do not show so many are passed over; all of them may be, where `segments` is large.
    """
    found, index = 0, 0
    while found < count:
        perception = _perceived(seed, index)
        index += 1
        chosen = np.argsort(np.where(perception.groups < 0, np.iinfo(np.int32).max, perception.groups), kind="stable")
        if len(chosen) < segments:
            if index > 4 * count + 20 and found == 0:
                raise ValueError(f"no simulated frame shows {segments} segments")
            continue
        found += 1
        yield _measured(perception, template, chosen[:segments])


def _measured(perception: _core.Perception, template: _core.Template, chosen: NDArray[np.int64]) -> Measured:
    def measure() -> _core.Problem:
        return _core.Problem.of_segments(perception, template, chosen.tolist())

    return measure(), measure


@cache
def _perceived(seed: int, index: int) -> _core.Perception:
    frame = make_frame(CATEGORIES[index % len(CATEGORIES)], seed, index)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    return perceive(cloud, **FINE)
