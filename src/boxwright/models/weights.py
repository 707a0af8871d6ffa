"""Learned weights of one template, as data (`boxwright.weights`, version 1)."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core


class LeftOut(msgspec.Struct, frozen=True):
    """One frame judged by weights that were fitted without it, means over its boxes."""

    frame: str
    correctness: float
    """(right - wrong) / panels of the best assignment."""
    reachable: float
    """That of the best that perception leaves possible."""


class TrainingReport(msgspec.Struct, frozen=True, kw_only=True):
    """How the weights came to be.

    Errors are those of the learner: of "ridge" root mean squares of predicted against true correctness; of "margin" the
    mean correctness that the best assignment lacks, of "likelihood" the mean -log of the truth's probability.
    """

    command: str
    learner: str = "ridge"
    frames: int
    candidates: int
    regularizer: float
    fit_error: float
    held_out_error: float
    rank_accuracy: float
    """Share of the training boxes of which the best candidate came first."""
    left_out: tuple[LeftOut, ...] = ()


class Calibration(msgspec.Struct, frozen=True, kw_only=True):
    """What each evidence of a part (`_core.EVIDENCE`) counts for it being right (docs/maths.md, eq. 64)."""

    rays: dict[str, float]
    """Where the rays of an image were asked."""
    blind: dict[str, float]
    """Where there were none."""


class LearnedWeights(msgspec.Struct, frozen=True, kw_only=True):
    """What each feature and relation counts, how much it matters, and from which score something is an object."""

    template: str
    weights: dict[str, float]
    importance: dict[str, float]
    accept_score: float
    temperature: float | None = None
    """T of the probabilities (docs/maths.md, eq. 49), in units of the score; None: not calibrated, taken as 1."""
    calibration: Calibration | None = None
    """From what is known of a part to the probability that it is right; None: its marginal as it is."""
    training: TrainingReport | None = None
    format: Literal["boxwright.weights"] = "boxwright.weights"
    version: Literal[1] = 1

    def vector(self, template: _core.Template) -> NDArray[np.float64]:
        """The weights (terms,) in the order of the template's features and relations."""
        names = template.feature_names + template.relation_names
        return np.array([self.weights[name] for name in names])

    def save(self, path: str | Path) -> None:
        """Writes the weights as JSON."""
        text = msgspec.json.format(msgspec.json.encode(self), indent=1)
        Path(path).write_bytes(text + b"\n")
