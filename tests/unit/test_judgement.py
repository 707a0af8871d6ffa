"""By what fitted boxes are judged: the learner against scipy, the file's names against the core's."""

from __future__ import annotations

import json

import msgspec
import numpy as np
import pytest
from scipy.optimize import minimize

from boxwright import _core
from boxwright.learning.judgement import RIDGE, Examples, LearnedJudgement, doubts_of, fit_logistic
from boxwright.models import JUDGEMENT_FILE


def _examples(count: int, seed: int) -> list[tuple[dict[str, float], bool]]:
    rng = np.random.default_rng(seed)
    rows = []
    for _ in range(count):
        a, b = rng.normal(size=2)
        is_right = bool(rng.random() < 1.0 / (1.0 + np.exp(-(0.5 + 1.5 * a - 0.7 * b))))
        rows.append(({"one": 1.0, "a": float(a), "b": 3.0 * float(b)}, is_right))
    return rows


def test_the_learner_finds_what_scipy_finds() -> None:
    checked = 0
    for seed in range(5):
        examples = _examples(300, seed)
        found = fit_logistic(examples)
        names = list(found)
        x = np.array([[features[name] for name in names] for features, _ in examples])
        y = np.array([is_right for _, is_right in examples], float)
        scale = np.where(np.array(names) == "one", 1.0, x.std(axis=0))
        held = np.where(np.array(names) == "one", 1e-6, RIDGE)

        def loss(w: np.ndarray, z: np.ndarray = x / scale, y: np.ndarray = y, held: np.ndarray = held) -> float:
            return float(np.logaddexp(0.0, z @ w).sum() - y @ (z @ w) + 0.5 * held @ w**2)

        best = minimize(loss, np.zeros(len(names)), tol=1e-12).x / scale
        np.testing.assert_allclose([found[name] for name in names], best, rtol=1e-3, atol=1e-4)
        checked += 1
    assert checked == 5


def test_a_judgement_that_does_not_fit_is_named() -> None:
    text = JUDGEMENT_FILE.read_text()
    unknown_leaf = ["no_such_feature", 0.5, 0.0, 1.0]
    changes = {
        "on_walls": lambda judgement: judgement["box"]["weights"].pop("on_walls"),
        "looked_inside": lambda judgement: judgement["lying"]["weights"].pop("looked_inside"),
        "lean": lambda judgement: judgement["part"]["weights"].pop("lean"),
        "no_such_weight": lambda judgement: judgement["box"]["weights"].update(no_such_weight=1.0),
        "no_such_feature": lambda judgement: judgement["part"]["trees"].append(["lean", 0.1, 0.0, unknown_leaf]),
        "told_from: 1.5": lambda judgement: judgement["part"].update(told_from=1.5),
        "told_from: 2": lambda judgement: judgement["box"]["doubts"][0].update(told_from=2.0),
        "doubts: no_such_one is not known": lambda judgement: judgement["box"]["doubts"][1].update(
            feature="no_such_one"
        ),
        "doubts: side_absent has not one": lambda judgement: judgement["box"]["doubts"][2].pop("above"),
        "doubts: shorter_edge has not one": lambda judgement: judgement["box"]["doubts"][0].update(above=1.0),
        "Tree": lambda judgement: judgement["box"]["trees"].append(["lean", 0.5]),
    }
    for expected, change in changes.items():
        broken = json.loads(text)
        change(broken)
        with pytest.raises(ValueError, match=f"judgement.*{expected}"):
            _core.Judgement(json.dumps(broken))


def test_the_shipped_judgement_is_what_the_learner_writes() -> None:
    """Doubted are small boxes, those without an inside and those that lack a side; from where, the rules say."""
    shipped = msgspec.json.decode(JUDGEMENT_FILE.read_text(), type=LearnedJudgement)
    edges = [float(edge) for edge in np.linspace(-3.0, 0.0, 101)]
    told = {"on_inner_faces": 1.0, "side_absent": 0.0}
    right = Examples(boxes=tuple(({"shorter_edge": edge} | told, True) for edge in edges), parts=())
    small, *others = doubts_of([right])
    assert small.feature == shipped.box.doubts[0].feature == "shorter_edge"
    assert small.below == pytest.approx(-2.97)
    assert tuple(others) == shipped.box.doubts[1:]
    assert not shipped.lying.doubts
    assert not shipped.part.doubts
