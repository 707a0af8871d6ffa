"""What an object was chosen against: the next best assignment of its template, and what decided between the two."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.models import LearnedWeights
from boxwright.pipeline import Inferred
from boxwright.types import Object

Search = Literal["staged", "exact"]

SAME_SCORE = 1e-9
"""Scores that are nearer differ by rounding alone."""

EVIDENCE = "evidence"
"""The kind of the score's terms of whole boxes; those of assignments have the paper's names."""

LISTS = (20, 200, 2000)
"""How many assignments are listed, one length after the other: many use segments that better objects have taken."""

Row = NDArray[np.int64]
"""(parts,): the problem's segment that plays each part, -1 for none."""

Segments = dict[str, int | None]
"""The segment that plays each part; None where the part is empty."""


@dataclass(frozen=True)
class Difference:
    """A term of which the object and its runner-up have different values."""

    name: str
    kind: str
    value: float
    runner_up_value: float
    weight: float

    @property
    def contribution(self) -> float:
        """What the term speaks for the object, against the runner-up where negative: weight x difference (eq. 1)."""
        return self.weight * (self.value - self.runner_up_value)


@dataclass(frozen=True)
class RunnerUp:
    """The best assignment after the object's own, told in the object's names; `search` says of which list.

    "exact": of all assignments. "staged": of those that the paper's search ranked. `differences` come largest first and
    their contributions sum to the distance of the scores. `refused` assignments score more than the object and were
    turned away by the template's rules.
    """

    search: Search
    score: float
    segments: Segments
    differences: tuple[Difference, ...]
    refused: int


def is_judged_whole(found: Object) -> bool:
    """Whether an object was judged as a whole box (docs/maths.md, eq. 90), not found as an assignment of segments."""
    return any(term.kind == EVIDENCE for term in found.score_terms)


def segments_of(inferred: Inferred, k: int) -> Segments:
    """The perception's segment that plays each part of object `k`."""
    mine = inferred.object_labels == k
    parts, segments = inferred.part_labels[mine], inferred.perception.labels[mine]
    found = dict(np.unique(np.column_stack([parts, segments]), axis=0).tolist())
    return {part.name: found.get(j) for j, part in enumerate(inferred.model.objects[k].parts)}


def runner_up(
    inferred: Inferred, k: int, template: _core.Template, weights: LearnedWeights, search: Search
) -> RunnerUp | None:
    """The runner-up of object `k`, which the template and weights given found; None where the list holds no other.

    Better objects of the same group keep their segments, as when the object was found. Raises ValueError where template
    and weights are not those of the object.
    """
    found = inferred.model.objects[k]
    problem = _problem_of(inferred, k, template)
    own = _row_of(segments_of(inferred, k), template, problem)
    if abs(float(problem.features(own[None, :])[0] @ weights.vector(template)) - found.score) > SAME_SCORE:
        raise ValueError(f"object {k}: its score {found.score:.6f} is not that of these weights and this template")
    used = [segment for better in range(k) for segment in segments_of(inferred, better).values() if segment is not None]
    taken = np.flatnonzero(np.isin(problem.scene_segments, used))
    for most in LISTS:
        rows, scores = _listed(problem, template, weights, search, most)
        others = np.array([not np.isin(row, taken).any() and not _is_copy(row, own, template) for row in rows], bool)
        after = np.flatnonzero(others & (scores <= found.score + SAME_SCORE))
        if len(after):
            row = max(_copies(rows[after[0]], template), key=lambda copy: int((copy == own).sum()))
            return RunnerUp(
                search=search,
                score=float(scores[after[0]]),
                segments=_named(row, template, problem),
                differences=_differences(problem, own, row, found),
                refused=int((others & (scores > found.score + SAME_SCORE)).sum()),
            )
        if len(rows) < most:
            break
    return None


def _problem_of(inferred: Inferred, k: int, template: _core.Template) -> _core.Problem:
    """The problem of the group that the object's segments are of."""
    mine = {segment for segment in segments_of(inferred, k).values() if segment is not None}
    for problem in _core.Problem.by_group(inferred.perception, template):
        if mine <= set(problem.scene_segments.tolist()):
            return problem
    raise ValueError(f"object {k}: its segments are of no group of the perception's")


def _listed(
    problem: _core.Problem, template: _core.Template, weights: LearnedWeights, search: Search, most: int
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """The best assignments (K, parts) and their scores (K,), best first, distinct up to symmetry."""
    vector = weights.vector(template)
    if search == "exact":
        return problem.solve(vector, most)[:2]
    importance = np.array([weights.importance[name] for name in template.feature_names + template.relation_names])
    return problem.rank(vector, importance, most)[:2]


def _copies(row: Row, template: _core.Template) -> list[Row]:
    """The same assignment under each symmetry of the template."""
    copies = []
    for turn in template.symmetries:
        copies.append(np.empty_like(row))
        copies[-1][turn] = row
    return copies


def _is_copy(row: Row, own: Row, template: _core.Template) -> bool:
    return any(np.array_equal(copy, own) for copy in _copies(row, template))


def _row_of(segments: Segments, template: _core.Template, problem: _core.Problem) -> Row:
    place = {int(segment): i for i, segment in enumerate(problem.scene_segments)}
    return np.array([-1 if (s := segments[part]) is None else place[s] for part in template.parts], np.int64)


def _named(row: Row, template: _core.Template, problem: _core.Problem) -> Segments:
    numbers = problem.scene_segments
    return {part: None if s < 0 else int(numbers[s]) for part, s in zip(template.parts, row, strict=True)}


def _differences(problem: _core.Problem, own: Row, other: Row, found: Object) -> tuple[Difference, ...]:
    values = problem.features(np.array([own, other]))
    told = [
        Difference(term.name, term.kind, float(a), float(b), term.weight)
        for term, a, b in zip(found.score_terms, *values, strict=True)
        if a != b
    ]
    return tuple(sorted(told, key=lambda difference: -abs(difference.contribution)))
