"""Trees that mend what a weighted sum gets wrong: gradient boosting (J. H. Friedman, Ann. Statist. 29, 2001)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Tree = float | list[Any]
"""A leaf's log odds, or [feature, bound, the tree up to it, the tree above]."""

TREES = 300
DEPTH = 4
RATE = 0.05
LEAF = 20
"""Examples of a leaf, at least."""
SHARE = 0.5
"""Of the examples that a tree, and of the features that a split is chosen from: drawn by a fixed seed."""
DIGITS = 6
"""Of a number in a tree."""


def require_learner() -> None:
    """Raises ValueError without scikit-learn; asked before anything long is done."""
    try:
        import sklearn.ensemble  # noqa: F401
    except ModuleNotFoundError as error:
        raise ValueError(f"learning needs {error.name}, which is missing; pip install 'boxwright[learn]'") from None


def fit_trees(examples: Sequence[tuple[dict[str, float], bool]], weights: dict[str, float]) -> list[Tree]:
    """Trees whose sum, added to that of the features times `weights`, tells what is right by its log odds.

    The same examples give the same trees. Raises ValueError without scikit-learn.
    """
    require_learner()
    from sklearn.ensemble import GradientBoostingClassifier

    names = list(weights)
    boosted = GradientBoostingClassifier(
        init=_Weighed(np.array(list(weights.values()))),
        n_estimators=TREES,
        max_depth=DEPTH,
        learning_rate=RATE,
        min_samples_leaf=LEAF,
        subsample=SHARE,
        max_features=SHARE,
        random_state=0,
    )
    x = np.array([[features[name] for name in names] for features, _ in examples])
    boosted.fit(x, np.array([is_right for _, is_right in examples], int))
    return [_told(estimator.tree_, 0, names) for (estimator,) in boosted.estimators_]


class _Weighed:
    """The weighted sum as what the boosting starts from; scikit-learn wants an estimator."""

    def __init__(self, weights: NDArray[np.float64]) -> None:
        self.weights = weights

    def fit(self, x: object, y: object, sample_weight: object = None) -> _Weighed:
        """There is nothing left to fit."""
        return self

    def predict_proba(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """Of wrong and right (n, 2)."""
        right = 1.0 / (1.0 + np.exp(-(x @ self.weights)))
        return np.column_stack([1.0 - right, right])


def _told(tree: Any, node: int, names: Sequence[str]) -> Tree:
    """A fitted tree of scikit-learn from a node on."""
    below = (tree.children_left[node], tree.children_right[node])
    if below[0] < 0:
        return _rounded(RATE * tree.value[node, 0, 0])
    up_to, above = (_told(tree, child, names) for child in below)
    return [names[tree.feature[node]], _rounded(tree.threshold[node]), up_to, above]


def _rounded(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
