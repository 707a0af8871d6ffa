"""A labelled frame as learning takes it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.types import Cloud, Truth


@dataclass(frozen=True, eq=False)
class SeenFrame:
    """A labelled frame after perception. `truth_labels` (N,): index of the true part + 1, 0 for none.

    `read` reads the cloud again, whose rays tell how far parts are seen; without it nothing is learnt of rays. `planes`
    is the front end that found the planes.
    """

    name: str
    perception: _core.Perception
    truth: Truth
    truth_labels: NDArray[np.uint16]
    read: Callable[[], Cloud] | None = None
    planes: str | None = None
