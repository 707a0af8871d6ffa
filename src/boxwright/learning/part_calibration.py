"""From what is known of a part to the probability that it is right: a logistic line over the evidence (eq. 64)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation import FrameScore, score_frame
from boxwright.learning.understood import Understood
from boxwright.models.weights import Calibration

STEPS = 50
"""Newton steps, at most."""

WEIGHT_DECAY = 1.0
"""Half of it times the square of what each evidence counts, in standard deviations, is paid; "one" is free."""

LEAST_MARGINAL = 0.02
"""What the marginal counts at least: more certain marginals never say less."""

ONE, MARGINAL = _core.EVIDENCE.index("one"), _core.EVIDENCE.index("marginal")
BLIND = _core.EVIDENCE.index("part_seen")
"""From here on only rays tell."""

Array = NDArray[np.float64]


class Verdict(NamedTuple):
    """A found part: its evidence (`_core.EVIDENCE`), whether the rays were asked, and whether it is right."""

    evidence: Sequence[float]
    has_rays: bool
    is_right: bool


def part_verdicts(understood: Understood) -> list[Verdict]:
    """Of each observed part of the objects; parts that are neither right nor wrong are left out."""
    objects, truth = understood.objects, understood.frame.truth
    score = score_frame(objects, understood.object_labels, understood.part_labels, truth, understood.frame.truth_labels)
    verdict_of = _verdicts(score)
    out = []
    for k, found in enumerate(objects):
        for part, evidence in zip(found.parts, understood.evidence[k], strict=True):
            # A part of an object that no box was given to is wrong.
            verdict = verdict_of.get((k, part.name), "wrong")
            if part.observed and evidence is not None and verdict != "neither":
                out.append(Verdict(evidence, part.state is not None, verdict == "right"))
    return out


def fit_calibration(verdicts: Iterable[Verdict]) -> Calibration | None:
    """The line of the greatest likelihood, with the rays and without; None where nothing is known.

    Frames whose rays were asked teach the line without rays too.
    """
    known = list(verdicts)
    if not known:
        return None
    evidence = np.array([v.evidence for v in known], np.float64)
    right = np.array([v.is_right for v in known], np.float64)
    has_rays = np.array([v.has_rays for v in known])
    blind = np.zeros(len(_core.EVIDENCE))
    blind[:BLIND] = _fit(evidence[:, :BLIND], right)
    rays = _fit(evidence[has_rays], right[has_rays]) if has_rays.any() else blind
    return Calibration(rays=_named(rays), blind=_named(blind))


def _fit(evidence: Array, right: Array) -> Array:
    """(E,) what each evidence (K, E) counts."""
    scale = evidence.std(axis=0)
    scale[scale < 1e-9] = 1.0
    middle = evidence.mean(axis=0)
    middle[ONE], scale[ONE] = 0.0, 1.0
    design = (evidence - middle) / scale
    line: Array = _most_likely(design, right) / scale
    if line[MARGINAL] < LEAST_MARGINAL:
        # Held there; the rest is fitted to what it leaves.
        held = design.copy()
        held[:, MARGINAL] = 0.0
        fixed = LEAST_MARGINAL * (evidence[:, MARGINAL] - middle[MARGINAL])
        line = _most_likely(held, right, fixed) / scale
        line[MARGINAL] = LEAST_MARGINAL
    line[ONE] -= float(np.delete(line * middle, ONE).sum())
    return line


def _most_likely(design: Array, right: Array, fixed: Array | float = 0.0) -> Array:
    """Newton's method for the logistic loss with `WEIGHT_DECAY`; `fixed` (K,) is added to each logit."""
    line: Array = np.zeros(design.shape[1])
    decay = np.full(len(line), WEIGHT_DECAY)
    # Something stays on it, so that verdicts that are all alike end somewhere.
    decay[ONE] = 1e-2
    for _ in range(STEPS):
        told: Array = 1.0 / (1.0 + np.exp(-(design @ line + fixed)))
        gradient: Array = design.T @ (told - right) + decay * line
        curvature = (design * (told * (1.0 - told))[:, None]).T @ design + np.diag(decay)
        step: Array = np.asarray(np.linalg.solve(curvature, gradient), np.float64)
        line = line - step / max(1.0, float(np.abs(step).max()))
        if np.abs(step).max() < 1e-10:
            break
    return line


def _named(line: Array) -> dict[str, float]:
    return dict(zip(_core.EVIDENCE, line.tolist(), strict=True))


def _verdicts(score: FrameScore) -> dict[tuple[int, str], str]:
    return {(box.object, v.name): v.verdict for box in score.boxes if box.object is not None for v in box.verdicts}
