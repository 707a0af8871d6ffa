"""What an object was chosen against."""

from __future__ import annotations

import numpy as np
import pytest

import boxwright
from boxwright import _core
from boxwright.models import load_template, load_weights
from boxwright.runner_up import runner_up, segments_of
from boxwright.simulation import make_frame
from boxwright.types import Cloud

CARTON = load_template("carton")
PLANES = "grid"
WEIGHTS = load_weights("carton", PLANES)


def _inferred(index: int, search: str):
    frame = make_frame("medium", 61, index, boxes=2)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    return boxwright.infer(cloud, method="paper", templates=("carton",), planes=PLANES, search={"search": search})


def _score(perception: _core.Perception, segments: dict[str, int | None]) -> float:
    """J(G) of an assignment, in the problem of its group."""
    used = {s for s in segments.values() if s is not None}
    for problem in _core.Problem.by_group(perception, CARTON):
        numbers = problem.scene_segments.tolist()
        if used <= set(numbers):
            row = [-1 if segments[part] is None else numbers.index(segments[part]) for part in CARTON.parts]
            return float(problem.features(np.array([row], np.int64))[0] @ WEIGHTS.vector(CARTON))
    raise AssertionError("segments of several groups")


@pytest.mark.parametrize("search", ["exact", "staged"])
def test_the_runner_up_is_another_assignment_and_the_differences_are_all_that_parts_them(search: str) -> None:
    cases = 0
    for index in range(3):
        inferred = _inferred(index, search)
        taken: set[int | None] = set()
        for k, found in enumerate(inferred.model.objects):
            mine = segments_of(inferred, k)
            assert [name for name, s in mine.items() if s is not None] == [p.name for p in found.parts if p.observed]
            assert _score(inferred.perception, mine) == pytest.approx(found.score, abs=1e-12)
            second = runner_up(inferred, k, CARTON, WEIGHTS, search)
            assert second is not None
            assert second.score <= found.score + 1e-9
            assert _score(inferred.perception, second.segments) == pytest.approx(second.score, abs=1e-12)
            assert mine != second.segments
            assert not taken & {s for s in second.segments.values() if s is not None}
            parted = sum(difference.contribution for difference in second.differences)
            assert parted == pytest.approx(found.score - second.score, abs=1e-12)
            sizes = [abs(difference.contribution) for difference in second.differences]
            assert sizes == sorted(sizes, reverse=True)
            taken |= {s for s in mine.values() if s is not None}
            cases += 1
    assert cases >= 4


def test_the_exact_runner_up_is_the_second_of_all() -> None:
    inferred = _inferred(0, "exact")
    second = runner_up(inferred, 0, CARTON, WEIGHTS, "exact")
    assert second is not None
    used = {s for s in segments_of(inferred, 0).values() if s is not None}
    problem = next(p for p in _core.Problem.by_group(inferred.perception, CARTON) if used <= set(p.scene_segments))
    scores = problem.solve(WEIGHTS.vector(CARTON), k=2)[1]
    assert inferred.model.objects[0].score == pytest.approx(scores[0], abs=1e-12)
    assert second.score == pytest.approx(scores[1], abs=1e-12)
    assert second.refused == 0


def test_weights_that_did_not_find_the_object_are_refused() -> None:
    inferred = _inferred(0, "exact")
    with pytest.raises(ValueError, match=r"object 0: its score .* is not that of these weights"):
        runner_up(inferred, 0, CARTON, load_weights("carton", "ransac"), "exact")
