"""Learners on exact inference: slopes are right, fits are optimal, residuals leave nothing of the box."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.learning.exact_rounds import ExactProblems, fit, grow
from boxwright.learning.likelihood import Prior, fit_likelihood, loss
from boxwright.learning.margin import fit_margin
from boxwright.learning.part_calibration import fit_calibration
from boxwright.learning.residuals import with_residuals
from boxwright.learning.stacks import Stack
from boxwright.learning.temperature import fit_temperature
from support.learning_frames import carton, problems_of, seen_frames


@pytest.fixture(scope="module")
def problems() -> ExactProblems:
    return ExactProblems.of(carton(), [problems_of(frame) for frame in seen_frames()])


def penalized(stack: Stack, prior: Prior, weights: np.ndarray) -> float:
    return float(stack.shares @ loss(stack, weights)) + prior.penalty(weights)


def hinge(stack: Stack, prior: Prior, weights: np.ndarray, held: list[int]) -> float:
    """Eq. 66, written out."""
    total = prior.penalty(weights)
    for i, best in enumerate(held):
        rows = stack.rows(i)
        x, y = stack.features[rows], stack.correctness[rows]
        total += stack.shares[i] * float(np.max(y.max() - y - (x[best] - x) @ weights))
    return total


def test_no_step_from_the_fits_goes_downhill(problems: ExactProblems) -> None:
    stack = problems.stack()
    terms = stack.features.shape[1]
    rng, cases = np.random.default_rng(3), 0
    start = np.zeros(terms)
    held = [int(np.argmax(stack.is_truth[stack.rows(i)])) for i in range(len(stack))]
    for center in (start, rng.normal(size=terms)):
        prior = Prior(center, 1.0 / stack.spread(), 0.1)
        likely, wide = fit_likelihood(stack, prior, start), fit_margin(stack, prior, start)
        least, widest = penalized(stack, prior, likely), hinge(stack, prior, wide, held)
        for _ in range(40):
            step = prior.unit * rng.normal(size=terms) * 10.0 ** rng.uniform(-3, 0)
            assert penalized(stack, prior, likely + step) >= least - 1e-9
            # Frank-Wolfe ends near the least, at a gap or after so many passes.
            assert hinge(stack, prior, wide + step, held) >= widest - 5e-3
            cases += 1
    assert cases == 80


def test_the_rounds_better_what_the_search_finds(problems: ExactProblems) -> None:
    center = np.zeros(len(carton().feature_names) + len(carton().relation_names))
    for learner in ("margin", "likelihood"):
        prior = Prior(center, 1.0 / problems.stack().spread(), 0.1)
        weights = fit(learner, problems.stack(), prior, center)
        assert grow(learner, problems, weights, 1) > 0
        weights = fit(learner, problems.stack(), prior, weights)
        found = [p.correctness(p.problem.solve(weights)[0])[0] for p in problems.problems if len(p.truths)]
        # The empty assignment has 0.
        assert np.mean(found) > 0.3
    temperature = fit_temperature(problems.stack(), 7.0 * weights)
    assert temperature == pytest.approx(7.0 * fit_temperature(problems.stack(), weights), rel=0.1)


def test_residuals_hold_no_segment_of_the_box_that_is_taken() -> None:
    cases = 0
    for frame in seen_frames():
        for learning in problems_of(frame):
            whole, *rest = with_residuals([learning])
            assert whole is learning
            assert len(rest) == len(learning.truths)
            for truth, residual in zip(learning.truths, rest, strict=True):
                taken = set(learning.problem.scene_segments[truth[truth >= 0]])
                assert not taken & set(residual.problem.scene_segments)
                assert len(taken) + len(residual.problem) == len(learning.problem)
                assert residual.gains.shape[2] == len(residual.problem) + 1
                assert (residual.correctness(residual.truths) > 0).all()
                cases += 1
    assert cases >= len(seen_frames())


def test_a_line_that_made_the_verdicts_is_found_again() -> None:
    rng = np.random.default_rng(5)
    marginals = rng.uniform(0.02, 0.98, 20000)
    logits = np.log(marginals / (1.0 - marginals))
    right = rng.uniform(size=len(marginals)) < 1.0 / (1.0 + np.exp(-0.5 * logits - 0.8))
    line = fit_calibration(zip(marginals.tolist(), right.tolist(), strict=True))
    assert line.slope == pytest.approx(0.5, abs=0.05)
    assert line.offset == pytest.approx(0.8, abs=0.05)
    unknown = fit_calibration([])
    assert (unknown.slope, unknown.offset) == (1.0, 0.0)
