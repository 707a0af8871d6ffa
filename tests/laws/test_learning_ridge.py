"""The normal equations of docs/maths.md (eqs. 12-13) against plain least squares on the stacked rows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from boxwright.learning.ridge import REGULARIZERS, FrameEquations, fit_ridge

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Rows:
    """Features (K, terms), correctness (K,) and sample weights (K,) of one or more frames."""

    features: Array
    correctness: Array
    samples: Array

    def equations(self) -> FrameEquations:
        return FrameEquations.of(self.features, self.correctness, self.samples)

    def squared_error(self, weights: Array) -> float:
        return float(np.sum(self.samples * (self.features @ weights - self.correctness) ** 2))


def stacked(frames: list[Rows]) -> Rows:
    return Rows(
        np.concatenate([f.features for f in frames]),
        np.concatenate([f.correctness for f in frames]),
        np.concatenate([f.samples for f in frames]),
    )


def random_frames(rng: np.random.Generator) -> list[Rows]:
    """Terms of very different spread, one of them now and then a copy of another or always 0."""
    terms, spread = int(rng.integers(2, 9)), 10.0 ** rng.uniform(-2, 2, 9)
    kind = rng.integers(4)
    truth = rng.normal(size=terms) / spread[:terms]
    frames = []
    for _ in range(int(rng.integers(2, 7))):
        count = int(rng.integers(1, 40))
        features = rng.normal(size=(count, terms)) * spread[:terms]
        if kind == 1:
            features[:, 0] = 0.0
        elif kind == 2:
            features[:, 0] = 3.0 * features[:, -1]
        correctness = features @ truth + rng.normal(size=count)
        frames.append(Rows(features, correctness, rng.uniform(0.01, 1.0, count)))
    return frames


def least_squares(rows: Rows, scale: Array, penalty: float) -> Array:
    """Minimum by a solver that never forms normal equations: the penalty as further rows."""
    root = np.sqrt(rows.samples)
    matrix = np.concatenate([rows.features * root[:, None], np.sqrt(penalty) * np.diag(scale)])
    solution = np.linalg.lstsq(matrix, np.concatenate([rows.correctness * root, np.zeros(len(scale))]), rcond=None)[0]
    return np.asarray(solution)


def spread_of(rows: Rows) -> Array:
    """Sample-weighted root mean square of each term, 1 for a term that is always 0."""
    scale = np.array([np.sqrt(np.average(column**2, weights=rows.samples)) for column in rows.features.T])
    return np.where(scale == 0.0, 1.0, scale)


def held_out_error(frames: list[Rows], scale: Array, regularizer: float) -> float:
    """Every frame told by weights that were fitted to the others alone."""
    total = 0.0
    for k, held_out in enumerate(frames):
        others = stacked(frames[:k] + frames[k + 1 :])
        total += held_out.squared_error(least_squares(others, scale, regularizer * others.samples.sum()))
    return float(np.sqrt(total / stacked(frames).samples.sum()))


def test_ridge_is_least_squares_and_its_leave_one_out_is_refitting() -> None:
    rng = np.random.default_rng(2011)
    cases = refits = 0
    chosen = set()
    for _ in range(60):
        frames = random_frames(rng)
        rows = stacked(frames)
        scale, total = spread_of(rows), float(rows.samples.sum())
        fit = fit_ridge([frame.equations() for frame in frames])
        np.testing.assert_allclose(fit.scale, scale, rtol=1e-9)

        errors = [held_out_error(frames, scale, regularizer) for regularizer in REGULARIZERS]
        assert fit.held_out_error == pytest.approx(min(errors), rel=1e-6)
        assert errors[REGULARIZERS.index(fit.regularizer)] == pytest.approx(min(errors), rel=1e-6)

        weights = least_squares(rows, scale, fit.regularizer * total)
        np.testing.assert_allclose(fit.weights * scale, weights * scale, atol=1e-6)
        assert fit.fit_error == pytest.approx(np.sqrt(rows.squared_error(weights) / total), rel=1e-6)
        refits += len(frames) * len(REGULARIZERS)
        chosen.add(fit.regularizer)
        cases += 1
    assert cases == 60
    assert refits > 1500
    assert len(chosen) > 3, "a regularizer that is always the same shows no choice"


def test_one_frame_cannot_be_held_out() -> None:
    frame = random_frames(np.random.default_rng(1))[0]
    with pytest.raises(ValueError, match="1 frames to learn from; at least 2"):
        fit_ridge([frame.equations()])
