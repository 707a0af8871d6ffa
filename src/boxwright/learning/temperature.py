"""The temperature at which the exact probabilities fit labelled frames best."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.likelihood import loss
from boxwright.learning.stacks import Stack

TRIED = np.geomspace(1e-3, 1e2, 151)
"""Temperatures, in units of the score."""


def fit_temperature(stack: Stack, weights: NDArray[np.float64]) -> float:
    """The temperature of those tried under which the truths of all pools are likeliest (eq. 61)."""
    losses = [float(stack.shares @ loss(stack, weights / temperature)) for temperature in TRIED]
    return round(float(TRIED[int(np.argmin(losses))]), 6)
