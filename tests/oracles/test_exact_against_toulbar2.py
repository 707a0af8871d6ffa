"""The exact search never falls below toulbar2's optimum. Skips where pytoulbar2 is not installed."""

from __future__ import annotations

import numpy as np
import pytest
from inference_problems import random_problems

from boxwright.models import load_template

pytest.importorskip("pytoulbar2")

ROUNDING = 1e-4
"""toulbar2 rounds each table entry to six decimals."""


@pytest.mark.parametrize(("name", "segments", "count"), [("carton", 9, 200), ("carton", 14, 60), ("cake_box", 6, 50)])
def test_the_optimum_is_toulbar2s(name: str, segments: int, count: int) -> None:
    from toulbar2_peer import best_score

    template = load_template(name)
    rng = np.random.default_rng(segments)
    cases = 0
    for problem in random_problems(template, segments, count, seed=segments):
        weights = rng.uniform(0.2, 1.0, len(template.feature_names) + len(template.relation_names))
        _, scores, status, gap, _ = problem.solve(weights)
        best, _, _ = best_score(*problem.score_tables(weights))
        assert (status, gap) == ("optimal", 0.0)
        assert scores[0] == pytest.approx(best, abs=ROUNDING)
        cases += 1
    assert cases == count
