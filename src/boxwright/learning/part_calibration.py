"""From a part's marginal to the probability that the part is right: one rising line between logits (eq. 64)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import FrameScore, score_frame
from boxwright.learning.understood import Understood
from boxwright.models.weights import Calibration

STEPS = 50
"""Newton steps, at most."""

WEIGHT_DECAY = 1.0
"""Half of it times the square of (slope - 1, offset) is paid: without evidence the marginal stays as it is."""

LEAST_SLOPE = 0.05
"""The order of the parts is never turned."""


def part_verdicts(understood: Understood) -> list[tuple[float, bool]]:
    """For each observed part with a probability, that and whether it is right; parts that are neither are left out."""
    objects, truth = understood.objects, understood.frame.truth
    score = score_frame(objects, understood.object_labels, understood.part_labels, truth, understood.frame.truth_labels)
    verdict_of = _verdicts(score)
    out = []
    for k, found in enumerate(objects):
        for part in found.parts:
            # A part of an object that no box was given to is wrong.
            verdict = verdict_of.get((k, part.name), "wrong") if k in _assigned(score) else "wrong"
            if part.observed and part.probability is not None and verdict != "neither":
                out.append((part.probability, verdict == "right"))
    return out


def fit_calibration(verdicts: Iterable[tuple[float, bool]]) -> Calibration:
    """The line of the greatest likelihood (Platt's), drawn towards the identity, of bare marginals."""
    pairs = np.array([(p, right) for p, right in verdicts], np.float64).reshape(-1, 2)
    inside = np.clip(pairs[:, 0], 1e-6, 1.0 - 1e-6)
    design = np.stack([np.log(inside / (1.0 - inside)), np.ones(len(inside))], axis=1)
    line = np.array([1.0, 0.0])
    for _ in range(STEPS):
        told = 1.0 / (1.0 + np.exp(-design @ line))
        gradient = design.T @ (told - pairs[:, 1]) + WEIGHT_DECAY * (line - [1.0, 0.0])
        curvature = (design * (told * (1.0 - told))[:, None]).T @ design + WEIGHT_DECAY * np.eye(2)
        step: NDArray[np.float64] = np.linalg.solve(curvature, gradient)
        line = line - step / max(1.0, float(np.abs(step).max()))
        if np.abs(step).max() < 1e-10:
            break
    return Calibration(slope=max(float(line[0]), LEAST_SLOPE), offset=float(line[1]))


def _verdicts(score: FrameScore) -> dict[tuple[int, str], str]:
    return {(box.object, v.name): v.verdict for box in score.boxes if box.object is not None for v in box.verdicts}


def _assigned(score: FrameScore) -> set[int]:
    return {box.object for box in score.boxes if box.object is not None}
