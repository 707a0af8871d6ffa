"""Figures of merit over many frames, by category, in the units that a person reads: per cent, degrees, millimetres."""

from __future__ import annotations

import math
from collections.abc import Sequence

import msgspec
import numpy as np

from boxwright.evaluation.scores import BoxScore, FlapError, FrameScore

CATEGORIES = ("small", "medium", "large", "carton", "cake", "pizza")
"""The categories of the paper's table, in its order; others follow in the order of their names, then `all`."""

ALL = "all"

USABLE_HINGE_ANGLE_RAD = math.radians(3.0)
USABLE_HINGE_DISTANCE_M = 0.010
USABLE_FLAP_ANGLE_RAD = math.radians(5.0)

MM_PER_M = 1000.0


class Spread(msgspec.Struct, frozen=True, kw_only=True):
    """Median and 90th percentile (linear between ranks) of `count` values; None where there is no value."""

    count: int
    median: float | None
    p90: float | None


class CategorySummary(msgspec.Struct, frozen=True, kw_only=True):
    """The figures of one category, or of all. A figure is None where nothing in the set has it.

    Accuracies are averaged over the boxes that have a panel of the kind in the cloud. Boxes go by their own category;
    frames, objects and false objects by the frame's. Hinge and angle errors are over right flaps that have a hinge;
    they and the share of usable flaps leave out flaps whose hinge the truth does not tell.
    """

    category: str
    frames: int
    objects: int
    false_objects: int
    boxes: int
    boxes_without_object: int
    flap_accuracy_percent: float | None
    full_accuracy_percent: float | None
    flaps_in_cloud: int
    flaps_right: int
    flaps_wrong: int
    tucks_in_cloud: int
    tucks_found: int
    usable_flaps_percent: float | None
    hinge_angle_deg: Spread
    hinge_distance_mm: Spread
    flap_angle_deg: Spread
    dimension_mm: Spread


class Summary(msgspec.Struct, frozen=True):
    """A summary for each category that occurs, and for all, which comes last."""

    categories: tuple[CategorySummary, ...]

    def category(self, name: str) -> CategorySummary:
        """The summary of that category; KeyError where the set has none."""
        for summary in self.categories:
            if summary.category == name:
                return summary
        raise KeyError(name)


def summarize(frames: Sequence[FrameScore]) -> Summary:
    """The figures of merit of a set of frames."""
    boxes = [box for frame in frames for box in frame.boxes]
    present = {frame.category for frame in frames} | {box.category for box in boxes}
    names = [name for name in CATEGORIES if name in present] + sorted(present - set(CATEGORIES))
    by_category = [
        _summarize(name, [f for f in frames if f.category == name], [b for b in boxes if b.category == name])
        for name in names
    ]
    return Summary((*by_category, _summarize(ALL, frames, boxes)))


def is_usable(error: FlapError) -> bool:
    """Whether an arm could act on the flap: 3 degrees and 10 mm of the hinge, 5 degrees of the angle."""
    return (
        error.hinge_angle_rad <= USABLE_HINGE_ANGLE_RAD
        and error.hinge_distance_m <= USABLE_HINGE_DISTANCE_M
        and error.flap_angle_rad <= USABLE_FLAP_ANGLE_RAD
    )


def _summarize(category: str, frames: Sequence[FrameScore], boxes: Sequence[BoxScore]) -> CategorySummary:
    errors = [error for box in boxes for error in box.flap_errors]
    flaps_in_cloud = sum(box.flaps_in_cloud for box in boxes)
    measured = flaps_in_cloud - sum(box.flaps_unmeasured for box in boxes)
    return CategorySummary(
        category=category,
        frames=len(frames),
        objects=sum(frame.objects for frame in frames),
        false_objects=sum(frame.false_objects for frame in frames),
        boxes=len(boxes),
        boxes_without_object=sum(box.object is None for box in boxes),
        flap_accuracy_percent=_mean_percent([box.flap_accuracy for box in boxes]),
        full_accuracy_percent=_mean_percent([box.full_accuracy for box in boxes]),
        flaps_in_cloud=flaps_in_cloud,
        flaps_right=sum(box.flaps_right for box in boxes),
        flaps_wrong=sum(box.flaps_wrong for box in boxes),
        tucks_in_cloud=sum(box.tucks_in_cloud for box in boxes),
        tucks_found=sum(box.tucks_found for box in boxes),
        usable_flaps_percent=100.0 * sum(map(is_usable, errors)) / measured if measured else None,
        hinge_angle_deg=_spread([math.degrees(error.hinge_angle_rad) for error in errors]),
        hinge_distance_mm=_spread([MM_PER_M * error.hinge_distance_m for error in errors]),
        flap_angle_deg=_spread([math.degrees(error.flap_angle_rad) for error in errors]),
        dimension_mm=_spread([MM_PER_M * error for box in boxes for error in box.dimension_errors_m or ()]),
    )


def _mean_percent(accuracies: Sequence[float | None]) -> float | None:
    told = [accuracy for accuracy in accuracies if accuracy is not None]
    return 100.0 * math.fsum(told) / len(told) if told else None


def _spread(values: Sequence[float]) -> Spread:
    if not values:
        return Spread(count=0, median=None, p90=None)
    return Spread(count=len(values), median=float(np.median(values)), p90=float(np.percentile(values, 90)))
