"""Trees on top of weights: what a sum cannot tell, and what scikit-learn says of the same trees."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.learning import boosting
from boxwright.learning.boosting import TREES, Tree, fit_trees
from boxwright.learning.judgement import fit_odds


def _examples(count: int, seed: int) -> list[tuple[dict[str, float], bool]]:
    """Right where two features have the same sign: no weighted sum tells it."""
    values = np.random.default_rng(seed).normal(size=(count, 3))
    return [({"one": 1.0, "a": a, "b": b, "c": c}, a * b > 0.0) for a, b, c in values.tolist()]


def _value(tree: Tree, features: dict[str, float]) -> float:
    """A second reading of the format, beside the core's."""
    while isinstance(tree, list):
        name, bound, up_to, above = tree
        tree = up_to if features[name] <= bound else above
    return tree


def test_trees_tell_what_weights_cannot() -> None:
    odds = fit_odds(_examples(400, 0), told_from=0.5)
    unseen = _examples(400, 1)
    weighed = [sum(odds.weights[name] * value for name, value in features.items()) for features, _ in unseen]
    mended = [sum(_value(tree, features) for tree in odds.trees) for features, _ in unseen]
    right = np.array([is_right for _, is_right in unseen])
    assert len(odds.trees) == TREES
    assert ((np.array(weighed) > 0) == right).mean() < 0.6
    assert ((np.array(weighed) + mended > 0) == right).mean() > 0.9


def test_the_same_examples_give_the_same_trees() -> None:
    weights = {"one": 0.1, "a": 0.2, "b": -0.3, "c": 0.0}
    assert fit_trees(_examples(200, 2), weights) == fit_trees(_examples(200, 2), weights)


def test_what_the_trees_start_from_is_not_told_again() -> None:
    """Of weights that tell all there is, trees have little to add."""
    values = np.random.default_rng(3).normal(size=300)
    draws = np.random.default_rng(4).random(300)
    examples = [
        ({"one": 1.0, "a": a}, bool(u < 1.0 / (1.0 + np.exp(-2.0 * a))))
        for a, u in zip(values.tolist(), draws.tolist(), strict=True)
    ]
    trees = {w: fit_trees(examples, {"one": 0.0, "a": w}) for w in (0.0, 2.0)}
    at = {w: sum(_value(tree, {"one": 1.0, "a": 1.5}) for tree in told) for w, told in trees.items()}
    assert at[0.0] == pytest.approx(3.0, abs=1.5)
    assert abs(at[2.0]) < 1.0


def test_the_extra_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "sklearn.ensemble", None)
    with pytest.raises(ValueError, match=r"sklearn.*boxwright\[learn\]"):
        boosting.fit_trees(_examples(50, 5), {"one": 0.0, "a": 0.0, "b": 0.0, "c": 0.0})
