"""What candidates are made of: each corruption differs from a truth as stated, and no segment plays two parts."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.candidates import CandidatePool
from boxwright.learning.problems import LearningProblem
from support.learning_frames import problems

Rows = NDArray[np.int64]


def kinds_of(pool: CandidatePool) -> list[Rows]:
    """Truths, one-panel and two-panel corruptions of a fresh pool, which weighs each kind the same."""
    candidates = pool.weighted()
    assert abs(candidates.sample_weights.sum() - 1.0) < 1e-12
    kind = np.floor(3.0 * (np.cumsum(candidates.sample_weights) - candidates.sample_weights / 2.0))
    return [candidates.assignments[kind == k] for k in range(3)]


def is_one_panel_step(start: Rows, end: Rows) -> bool:
    """One part became empty or took a segment that nobody had, or two parts have changed places."""
    changed = np.flatnonzero(start != end)
    if len(changed) == 1:
        taken = end[changed[0]]
        return bool(taken == -1 or taken not in start)
    return len(changed) == 2 and bool(start[changed[0]] == end[changed[1]] and start[changed[1]] == end[changed[0]])


def all_one_panel_steps(truth: Rows, segments: int) -> set[tuple[int, ...]]:
    """By listing them: the parts that can change are few."""
    steps = set()
    for part in range(len(truth)):
        for segment in {-1, *range(segments)} - {int(s) for s in truth if s >= 0}:
            steps.add((*truth[:part], segment, *truth[part + 1 :]))
    for p, q in combinations(range(len(truth)), 2):
        swapped = truth.copy()
        swapped[[p, q]] = truth[[q, p]]
        steps.add(tuple(swapped))
    return {tuple(map(int, step)) for step in steps} - {tuple(map(int, truth))}


def boxed() -> list[LearningProblem]:
    return [learning for _, learning in problems() if len(learning.truths)]


def test_one_panel_corruptions_are_all_that_one_step_reaches() -> None:
    cases = 0
    for learning in boxed():
        truths, one, _ = kinds_of(CandidatePool(learning, seed=0))
        assert np.array_equal(truths, learning.truths)
        assert all(any(is_one_panel_step(truth, row) for truth in truths) for row in one)
        expected = set().union(*(all_one_panel_steps(truth, len(learning.problem)) for truth in truths))
        assert {tuple(row) for row in one.tolist()} == expected
        assert len(one) == len(expected), "a corruption stands twice"
        cases += len(one)
    assert cases > 500


def test_two_panel_corruptions_are_two_steps_away_at_most() -> None:
    cases = two_steps = 0
    for learning in boxed():
        truths, one, two = kinds_of(CandidatePool(learning, seed=0))
        for row in two:
            if any(np.array_equal(row, near) for near in (*truths, *one)):
                cases += 1
                continue
            assert any(is_one_panel_step(near, row) for near in one), row
            cases, two_steps = cases + 1, two_steps + 1
    assert cases > 500
    assert two_steps > cases / 2


def test_no_segment_plays_two_parts_and_none_is_made_up() -> None:
    cases = 0
    for _, learning in problems():
        pool = CandidatePool(learning, seed=3)
        terms = learning.problem.features(learning.truths).shape[1]
        for sign in (1.0, -1.0):
            pool.add_top(np.full(terms, sign), np.ones(terms))
        for row in pool.weighted().assignments:
            used = row[row >= 0]
            assert len(set(used.tolist())) == len(used)
            assert -1 <= row.min() <= row.max() < len(learning.problem)
            cases += 1
    assert cases > 2000


def test_what_earlier_weights_liked_stays_in() -> None:
    grown = 0
    for _, learning in problems():
        pool = CandidatePool(learning, seed=3)
        terms = learning.problem.features(learning.truths).shape[1]
        before: set[tuple[int, ...]] = set()
        for sign in (1.0, -1.0, 1.0):
            pool.add_top(np.full(terms, sign), np.ones(terms))
            after = {tuple(row) for row in pool.weighted().assignments.tolist()}
            assert before <= after
            grown += before < after
            before = after
    assert grown > len(problems())


def test_equal_seeds_give_equal_candidates_and_others_do_not() -> None:
    cases = differing = 0
    for learning in boxed():
        first, again, other = (kinds_of(CandidatePool(learning, seed=seed))[2] for seed in (5, 5, 6))
        assert np.array_equal(first, again)
        differing += not np.array_equal(first, other)
        cases += 1
    assert cases >= 6
    assert differing >= cases - 1
