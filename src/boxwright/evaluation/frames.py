"""Score one labelled frame by docs/formats.md, "The figures of merit"."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation.assignment import assign
from boxwright.evaluation.errors import dimension_errors, flap_error
from boxwright.evaluation.overlap import Counts, Overlap, count_overlap
from boxwright.evaluation.roles import FLAP, TUCK, kind_of
from boxwright.evaluation.scores import BoxScore, FlapError, FrameScore
from boxwright.evaluation.verdicts import PANEL_READINGS, Rotated, judge, true_panels
from boxwright.types import Object, TrueBox, Truth

BOX_READINGS = 6000
"""A true box with fewer readings is neither asked for nor false."""


def score_frame(
    objects: tuple[Object, ...],
    object_labels: NDArray[np.integer],
    part_labels: NDArray[np.integer],
    truth: Truth,
    truth_labels: NDArray[np.integer],
) -> FrameScore:
    """Score the objects of a frame against its truth.

    `object_labels` and `part_labels` are as in `infer`'s labels.npz, `truth_labels` as in the scene set, all (N,).
    Raises ValueError when labels are not as many as each other or name what is not there.
    """
    overlap = count_overlap(objects, object_labels, part_labels, truth, truth_labels)
    box_of_object = assign(_shared_with_boxes(overlap, truth))
    object_of_box = {box: k for k, box in box_of_object.items()}
    asked = [b for b in range(len(truth.boxes)) if _box_readings(overlap, truth, b) >= BOX_READINGS]
    return FrameScore(
        name=truth.name,
        category=truth.category,
        objects=len(objects),
        false_objects=len(objects) - len(box_of_object),
        boxes=tuple(_score_box(objects, object_of_box.get(b), overlap, truth, b) for b in asked),
    )


def _panel_columns(truth: Truth, b: int) -> list[int]:
    return [i for i, part in enumerate(truth.parts) if part.box == truth.boxes[b].index]


def _box_readings(overlap: Overlap, truth: Truth, b: int) -> int:
    return int(overlap.readings[_panel_columns(truth, b)].sum())


def _shared_with_boxes(overlap: Overlap, truth: Truth) -> Counts:
    """(objects, boxes): the points of an object that lie on any panel of a box."""
    shared = np.zeros((len(overlap.object_on_true), len(truth.boxes)), np.int64)
    for b in range(len(truth.boxes)):
        shared[:, b] = overlap.object_on_true[:, _panel_columns(truth, b)].sum(axis=1)
    return shared


def _score_box(objects: tuple[Object, ...], k: int | None, overlap: Overlap, truth: Truth, b: int) -> BoxScore:
    """The score of box b, which object k was assigned to; without an object every count of right and wrong is 0."""
    true_box = truth.boxes[b]
    panels = true_panels(truth, true_box.index)
    in_cloud = [name for name, i in panels.items() if overlap.readings[i] >= PANEL_READINGS]
    best = None if k is None else _best_rotation(objects[k], overlap.part_on_true[k], overlap.readings, truth, true_box)
    right = {v.role for v in best.verdicts if v.verdict == "right"} if best else set()
    return BoxScore(
        box=true_box.index,
        category=true_box.category,
        variant=true_box.variant,
        readings=_box_readings(overlap, truth, b),
        object=k,
        rotation=best.rotation if best else None,
        flaps_in_cloud=_count(in_cloud, FLAP),
        flaps_right=best.count("right", FLAP) if best else 0,
        flaps_wrong=best.count("wrong", FLAP) if best else 0,
        panels_in_cloud=len(in_cloud) - _count(in_cloud, TUCK),
        panels_right=best.count_panels("right") if best else 0,
        panels_wrong=best.count_panels("wrong") if best else 0,
        tucks_in_cloud=_count(in_cloud, TUCK),
        tucks_found=best.count("right", TUCK) if best else 0,
        tucks_wrong=best.count("wrong", TUCK) if best else 0,
        missed=tuple(name for name in in_cloud if name not in right),
        verdicts=best.verdicts if best else (),
        flap_errors=_flap_errors(objects[k], best, truth, panels) if k is not None and best else (),
        dimension_errors_m=dimension_errors(objects[k], true_box, best.rotation) if k is not None and best else None,
        flaps_unmeasured=sum(
            kind_of(name) == FLAP and truth.parts[panels[name]].angle_deg is None for name in in_cloud
        ),
    )


def _best_rotation(
    model_object: Object, part_on_true: Counts, readings: Counts, truth: Truth, true_box: TrueBox
) -> Rotated:
    """The rotation of the greatest merit; where parts cannot tell, that of the nearer dimensions, then the first."""

    def merit(candidate: Rotated) -> tuple[int, int, int, float]:
        errors = dimension_errors(model_object, true_box, candidate.rotation)
        return (*candidate.merit(), -sum(errors or ()))

    return max(judge(model_object, part_on_true, readings, truth, true_box.index), key=merit)


def _flap_errors(model_object: Object, best: Rotated, truth: Truth, panels: dict[str, int]) -> tuple[FlapError, ...]:
    """Errors of the right flaps that have a hinge, and a measured one in the truth."""
    joint_of = {joint.child: joint for joint in model_object.joints}
    return tuple(
        flap_error(joint_of[v.name], truth.parts[panels[v.role]], v.role)
        for v in best.verdicts
        if v.verdict == "right" and kind_of(v.name) == FLAP and v.name in joint_of
        if truth.parts[panels[v.role]].angle_deg is not None
    )


def _count(names: list[str], kind: str) -> int:
    return sum(kind_of(name) == kind for name in names)
