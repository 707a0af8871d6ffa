"""Multinomial logistic regression: from the shapes of fitted boxes to their templates (docs/maths.md, eq. 89)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.likelihood import Prior, fit_likelihood, loss
from boxwright.learning.stacks import Stack
from boxwright.models.kinds import KindsReport, LearnedKinds

Array = NDArray[np.float64]

FOLDS = 5
REGULARIZERS = (1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2)
"""Of these the one is taken under which held-out boxes are most probable; in units of a box's -log probability."""


@dataclass(frozen=True, eq=False)
class KindExamples:
    """B fitted boxes: `features` (B, F) of their shapes, their true `templates`, and which frame each is from."""

    feature_names: tuple[str, ...]
    features: Array
    templates: tuple[str, ...]
    frames: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.templates)

    def of(self, chosen: NDArray[np.bool_]) -> KindExamples:
        """Those of a mask (B,)."""
        templates = tuple(name for name, taken in zip(self.templates, chosen, strict=True) if taken)
        return KindExamples(self.feature_names, self.features[chosen], templates, self.frames[chosen])


def learn_kinds(examples: KindExamples, command: str) -> LearnedKinds:
    """Weights by maximum likelihood, drawn to 0; frames are held out whole, and decide how strongly.

    Raises ValueError where there are fewer than two templates, or fewer boxes than folds.
    """
    names = tuple(sorted(set(examples.templates)))
    if len(names) < 2 or len(examples) < FOLDS:
        raise ValueError(f"{len(examples)} boxes of {len(names)} templates; kinds are learnt from more of both")
    tried = [(_held_out(examples, names, strength), strength) for strength in REGULARIZERS]
    (held_error, accuracy), strength = min(tried, key=lambda one: (one[0][0], one[1]))
    weights = _fit(examples, names, strength)
    report = KindsReport(
        command=command,
        boxes=len(examples),
        regularizer=strength,
        fit_error=float(loss(_stack(examples, names), weights.ravel()).mean()),
        held_out_error=held_error,
        held_out_accuracy=accuracy,
    )
    told = {
        name: dict(zip(examples.feature_names, row.tolist(), strict=True))
        for name, row in zip(names, weights, strict=True)
    }
    return LearnedKinds(weights=told, training=report)


def _held_out(examples: KindExamples, names: tuple[str, ...], strength: float) -> tuple[float, float]:
    """Mean -log probability and share of right templates of boxes by weights fitted to the other folds' frames."""
    error, right = 0.0, 0
    for fold in range(FOLDS):
        held = examples.frames % FOLDS == fold
        if not held.any():
            continue
        weights = _fit(examples.of(~held), names, strength)
        mine = examples.of(held)
        error += float(loss(_stack(mine, names), weights.ravel()).sum())
        best = np.argmax(mine.features @ weights.T, axis=1)
        right += sum(names[k] == name for k, name in zip(best, mine.templates, strict=True))
    return error / len(examples), right / len(examples)


def _fit(examples: KindExamples, names: tuple[str, ...], strength: float) -> Array:
    """The weights (templates, F)."""
    spread = examples.features.std(axis=0)
    # What never varies is known by its size; the intercept is hardly drawn to 0.
    spread[spread == 0.0] = 1.0
    unit = np.tile(1.0 / spread, len(names))
    start = np.zeros(len(names) * examples.features.shape[1])
    return fit_likelihood(_stack(examples, names), Prior(start, unit, strength), start).reshape(len(names), -1)


def _stack(examples: KindExamples, names: tuple[str, ...]) -> Stack:
    """Each box is a problem; its choices are the templates, each of which has the box's features for its own."""
    boxes, count = len(examples), len(names)
    features = np.zeros((boxes, count, count, examples.features.shape[1]))
    for k in range(count):
        features[:, k, k] = examples.features
    is_truth = np.array([[name == other for other in names] for name in examples.templates], bool).ravel()
    return Stack(
        features=features.reshape(boxes * count, -1),
        correctness=is_truth.astype(np.float64),
        log_copies=np.zeros(boxes * count),
        is_truth=is_truth,
        starts=np.arange(boxes) * count,
        shares=np.full(boxes, 1.0 / boxes),
    )
