"""Learners on exact inference: slopes are right, fits are optimal, residuals leave nothing of the box."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright import _core
from boxwright.learning.exact_rounds import ExactProblems, fit, grow
from boxwright.learning.likelihood import Prior, fit_likelihood, loss
from boxwright.learning.margin import fit_margin
from boxwright.learning.part_calibration import Verdict, fit_calibration
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
    names, count = _core.EVIDENCE, 40000
    evidence = rng.uniform(-1.0, 1.0, (count, len(names))) * rng.uniform(0.5, 4.0, len(names))
    evidence[:, names.index("one")] = 1.0
    made = dict(zip(names, (0.8, 0.5, 0.3, -1.0, 2.0, -1.5, -0.7, 0.4), strict=True))
    right = rng.uniform(size=count) < 1.0 / (1.0 + np.exp(-evidence @ np.array(list(made.values()))))
    found = fit_calibration(Verdict(row, True, ok) for row, ok in zip(evidence.tolist(), right.tolist(), strict=True))
    assert found is not None
    assert found.rays == pytest.approx(made, abs=0.1)
    rays_alone = names[names.index("part_seen") :]
    assert all(found.blind[name] == 0.0 for name in rays_alone)
    assert fit_calibration([]) is None


def test_more_certain_marginals_never_say_less() -> None:
    rng = np.random.default_rng(6)
    evidence = rng.uniform(-1.0, 1.0, (2000, len(_core.EVIDENCE)))
    evidence[:, _core.EVIDENCE.index("one")] = 1.0
    right = rng.uniform(size=2000) < 1.0 / (1.0 + np.exp(3.0 * evidence[:, _core.EVIDENCE.index("marginal")]))
    for has_rays in (True, False):
        verdicts = (Verdict(row, has_rays, ok) for row, ok in zip(evidence.tolist(), right.tolist(), strict=True))
        line = fit_calibration(verdicts)
        assert line is not None
        assert line.rays["marginal"] > 0.0
        assert line.blind["marginal"] > 0.0
