"""A labelled frame as learning takes it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.types import Truth


@dataclass(frozen=True, eq=False)
class SeenFrame:
    """A labelled frame after perception. `truth_labels` (N,): index of the true part + 1, 0 for none."""

    name: str
    perception: _core.Perception
    truth: Truth
    truth_labels: NDArray[np.uint16]
