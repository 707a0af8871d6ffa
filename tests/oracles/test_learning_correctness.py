"""What learning calls correct (docs/maths.md, eq. 11) is what the evaluation says of the same answer.

The evaluation reads an object under the four rotations, for the body tells a box from its mirror image; learning reads
an assignment before there is a body. So the evaluation is asked for both readings of an assignment.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import score_frame
from boxwright.learning import SeenFrame
from boxwright.learning.candidates import CandidatePool
from boxwright.learning.problems import LearningProblem
from boxwright.types import Inference, Object, Part
from support.learning_frames import carton, problems, problems_of, seen_frames

PER_PROBLEM = 25
"""Assignments that are looked at in each problem, beside the truths."""

MIRROR = {"side_1": "side_3", "side_3": "side_1", "flap_1": "flap_3", "flap_3": "flap_1"}

Rows = NDArray[np.int64]


def as_object(names: list[str], row: Rows) -> Object:
    parts = tuple(
        Part(name=name, observed=bool(segment >= 0), state=None, corners=CORNERS if segment >= 0 else None, points=0)
        for name, segment in zip(names, row, strict=True)
    )
    return Object(
        template="carton",
        template_probability=None,
        score=1.0,
        probability=None,
        inference=Inference(status="gap", gap=None, alternatives=0),
        dimensions=None,
        outer_dimensions=None,
        thickness=None,
        pose=None,
        parameters={},
        parts=parts,
        joints=(),
    )


CORNERS = ((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0))


def evaluated(frame: SeenFrame, learning: LearningProblem, row: Rows) -> float | None:
    """The full model accuracy of the frame's one box; None where the object shares no point with it."""
    part_of_segment = np.full(len(frame.perception) + 1, -1, np.int16)
    for part, segment in enumerate(row):
        if segment >= 0:
            part_of_segment[learning.problem.scene_segments[segment]] = part
    part_labels = part_of_segment[frame.perception.labels]
    object_labels = np.where(part_labels >= 0, np.int16(0), np.int16(-1))
    accuracies = []
    for names in (carton().parts, [MIRROR.get(name, name) for name in carton().parts]):
        objects = (as_object(names, row),)
        (box,) = score_frame(objects, object_labels, part_labels, frame.truth, frame.truth_labels).boxes
        if box.object is not None and box.full_accuracy is not None:
            accuracies.append(box.full_accuracy)
    return max(accuracies, default=None)


def sampled(learning: LearningProblem) -> Rows:
    """The truths, and corruptions and what the search likes, drawn with a stated seed."""
    pool = CandidatePool(learning, seed=1)
    terms = learning.problem.features(learning.truths).shape[1]
    pool.add_top(np.ones(terms), np.ones(terms))
    rows = pool.weighted().assignments
    drawn = np.random.default_rng(1).choice(len(rows), min(PER_PROBLEM, len(rows)), replace=False)
    return np.concatenate([learning.truths, rows[drawn]])


def boxed(boxes: int) -> Iterator[tuple[SeenFrame, LearningProblem]]:
    """Problems with a box in frames of so many."""
    for frame, learning in problems():
        if len(frame.truth.boxes) == boxes and len(learning.truths):
            yield frame, learning


def alone(frame: SeenFrame, box: int) -> SeenFrame:
    """The frame with one true box alone: what lay on another lies on nothing."""
    kept = [k for k, part in enumerate(frame.truth.parts) if part.box == box]
    renumbered = np.zeros(len(frame.truth.parts) + 1, np.uint16)
    renumbered[[k + 1 for k in kept]] = np.arange(1, len(kept) + 1)
    truth = msgspec.structs.replace(
        frame.truth,
        boxes=tuple(b for b in frame.truth.boxes if b.index == box),
        parts=tuple(frame.truth.parts[k] for k in kept),
    )
    return SeenFrame(frame.name, frame.perception, truth, renumbered[frame.truth_labels])


def test_correctness_is_the_evaluations_full_model_accuracy() -> None:
    cases, values = 0, set()
    for frame, learning in boxed(1):
        rows = sampled(learning)
        for row, correctness in zip(rows, learning.correctness(rows), strict=True):
            accuracy = evaluated(frame, learning, row)
            if accuracy is not None:
                assert abs(accuracy - correctness) < 1e-12, (frame.name, row, accuracy, correctness)
                values.add(round(accuracy, 6))
                cases += 1
    assert cases > 80
    assert len(values) > 8
    assert min(values) < 0.0 < 0.6 < max(values)


def test_with_two_boxes_the_better_one_counts() -> None:
    cases = 0
    for frame, learning in boxed(2):
        rows = sampled(learning)
        each = []
        for box in frame.truth.boxes:
            (same,) = (
                other
                for other in problems_of(alone(frame, box.index))
                if np.array_equal(other.problem.scene_segments, learning.problem.scene_segments)
            )
            if len(same.truths):
                each.append(same.correctness(rows))
        assert np.array_equal(learning.correctness(rows), np.max(each, axis=0))
        cases += len(rows)
    assert cases > 40


def test_every_filled_part_is_wrong_where_no_box_shows() -> None:
    cases, parts = 0, len(carton().parts)
    for frame in seen_frames():
        nothing = msgspec.structs.replace(frame.truth, boxes=(), parts=())
        empty = SeenFrame(frame.name, frame.perception, nothing, np.zeros_like(frame.truth_labels))
        for learning in problems_of(empty):
            assert learning.truths.shape == (0, parts)
            rows = sampled(learning)
            expected = -(rows >= 0).sum(axis=1) / parts
            np.testing.assert_allclose(learning.correctness(rows), expected, atol=1e-15)
            cases += len(rows)
    assert cases > 100
