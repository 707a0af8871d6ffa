"""Regularized normal equations (eqs. 12-13 of docs/maths.md) with leave-one-frame-out error."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

REGULARIZERS = tuple(float(10.0**k) for k in range(-5, 3))
"""Regularizers that are tried, as shares of the mean sample weight of a frame."""


@dataclass(frozen=True, eq=False)
class FrameEquations:
    """One frame's share of the normal equations: `moment` = X^T W X, `target` = X^T W y, `power` = y^T W y."""

    moment: Array
    target: Array
    power: float
    weight: float

    @staticmethod
    def of(features: Array, correctness: Array, sample_weights: Array) -> FrameEquations:
        """From features (K, terms), correctness (K,) and sample weights (K,)."""
        weighted = features * sample_weights[:, None]
        return FrameEquations(
            moment=weighted.T @ features,
            target=weighted.T @ correctness,
            power=float(correctness @ (sample_weights * correctness)),
            weight=float(sample_weights.sum()),
        )

    def squared_error(self, weights: Array) -> float:
        """Sample-weighted sum of squared errors of X w against y."""
        return float(weights @ self.moment @ weights - 2.0 * weights @ self.target + self.power)


@dataclass(frozen=True, eq=False)
class RidgeFit:
    """The fit under the regularizer of the least held-out error; errors are root mean squares of correctness."""

    weights: Array
    scale: Array
    """Root mean square of each term over the candidates: what a weight is worth."""
    regularizer: float
    fit_error: float
    held_out_error: float


def fit_ridge(frames: list[FrameEquations]) -> RidgeFit:
    """Fits weights (terms,) to all frames; the regularizer is chosen by leaving each frame out in turn.

    Raises ValueError without at least two frames: nothing could be held out.
    """
    if len(frames) < 2:
        raise ValueError(f"{len(frames)} frames to learn from; at least 2 are needed, since each is held out in turn")
    moment = np.sum([f.moment for f in frames], axis=0)
    target = np.sum([f.target for f in frames], axis=0)
    total = sum(f.weight for f in frames)
    scale = np.sqrt(np.diag(moment) / total)
    scale[scale == 0.0] = 1.0
    errors = [_held_out_error(frames, moment, target, scale, r) for r in REGULARIZERS]
    regularizer = REGULARIZERS[int(np.argmin(errors))]
    weights = _solve(moment, target, scale, regularizer * total)
    fit_error = np.sqrt(max(sum(f.squared_error(weights) for f in frames), 0.0) / total)
    return RidgeFit(weights, scale, regularizer, float(fit_error), float(min(errors)))


def _solve(moment: Array, target: Array, scale: Array, penalty: float) -> Array:
    """argmin over w of |X w - y|^2 + penalty |scale w|^2: terms are penalised in the units of their own spread."""
    scaled = moment / np.outer(scale, scale)
    solution = np.linalg.solve(scaled + penalty * np.eye(len(scale)), target / scale)
    return np.asarray(solution / scale, np.float64)


def _held_out_error(
    frames: list[FrameEquations], moment: Array, target: Array, scale: Array, regularizer: float
) -> float:
    total = sum(f.weight for f in frames)
    held_out = 0.0
    for frame in frames:
        penalty = regularizer * (total - frame.weight)
        weights = _solve(moment - frame.moment, target - frame.target, scale, penalty)
        held_out += frame.squared_error(weights)
    return float(np.sqrt(max(held_out, 0.0) / total))
