"""What every learner hands on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class Learned:
    """Weights (terms,) with what each term matters (terms,), and how well they do; errors are the learner's own."""

    weights: NDArray[np.float64]
    importance: NDArray[np.float64]
    candidates: int
    regularizer: float
    fit_error: float
    held_out_error: float
    rank_accuracy: float
