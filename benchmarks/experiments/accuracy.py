"""The paper's two accuracies over boxes, and their spread."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from boxwright.evaluation import BoxScore, FrameScore

PERCENT = 100.0


def boxes_of(scores: Iterable[FrameScore]) -> list[BoxScore]:
    """All boxes that are asked for."""
    return [box for score in scores for box in score.boxes]


def flap_percent(boxes: Iterable[BoxScore]) -> float | None:
    """Flap inference accuracy: the mean over boxes that show a flap."""
    return _mean_percent(box.flap_accuracy for box in boxes)


def full_percent(boxes: Iterable[BoxScore]) -> float | None:
    """Full model inference accuracy: the mean over boxes that show a panel."""
    return _mean_percent(box.full_accuracy for box in boxes)


def share_percent(boxes: Sequence[BoxScore], count: Callable[[BoxScore], int]) -> float:
    """What is counted, of all panels in the cloud."""
    return PERCENT * sum(map(count, boxes)) / max(sum(box.panels_in_cloud for box in boxes), 1)


def spread(values: Iterable[float | None]) -> tuple[float, float] | None:
    """Mean and standard deviation of those that are told; None of none."""
    told = [value for value in values if value is not None]
    return (float(np.mean(told)), float(np.std(told))) if told else None


def plus_minus(values: Iterable[float | None]) -> str:
    """Mean and standard deviation as text."""
    found = spread(values)
    return "-" if found is None else f"{found[0]:.1f} ± {found[1]:.1f}"


def _mean_percent(accuracies: Iterable[float | None]) -> float | None:
    told = [accuracy for accuracy in accuracies if accuracy is not None]
    return PERCENT * float(np.mean(told)) if told else None
