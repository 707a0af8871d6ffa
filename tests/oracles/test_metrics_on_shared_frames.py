"""The truth of the shared labelled frames, told as a model, scores all; told wrongly, it scores what it should."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import numpy as np

from boxwright.evaluation import FrameScore, LabelledFrame, read_set, score_frame, summarize
from boxwright.types import Inference, Joint, Object, Part, TruePart


def answer_of(frame: LabelledFrame, turn_rad: float) -> FrameScore:
    """Score the truth as if a method had said it, every flap's angle too large by `turn_rad`."""
    objects, object_labels = [], np.full(len(frame.labels), -1, np.int16)
    part_labels = object_labels.copy()
    for k, box in enumerate(frame.truth.boxes):
        mine = [(i, part) for i, part in enumerate(frame.truth.parts) if part.box == box.index]
        for j, (i, _) in enumerate(mine):
            object_labels[frame.labels == i + 1] = k
            part_labels[frame.labels == i + 1] = j
        objects.append(_object([part for _, part in mine], box.dims, turn_rad))
    return score_frame(tuple(objects), object_labels, part_labels, frame.truth, frame.labels)


def _object(parts: list[TruePart], dims: tuple[float, float, float], turn_rad: float) -> Object:
    return Object(
        template="carton",
        template_probability=None,
        score=1.0,
        probability=None,
        inference=Inference(status="gap", gap=None, alternatives=0),
        dimensions=dims,
        outer_dimensions=None,
        thickness=None,
        pose=None,
        parameters={},
        parts=tuple(_part(part) for part in parts),
        joints=tuple(_joint(part, turn_rad) for part in parts if part.name.startswith("flap")),
    )


def _name(part: TruePart) -> str:
    return part.name if part.name == "base" else f"{part.name[:4]}_{part.name[4]}"


def _part(part: TruePart) -> Part:
    return Part(
        name=_name(part), observed=part.visible_px > 0, state=None, corners=part.corners, points=part.visible_px
    )


def _joint(part: TruePart, turn_rad: float) -> Joint:
    start, end = np.array(part.corners[0]), np.array(part.corners[1])
    along = (end - start) / np.linalg.norm(end - start)
    ox, oy, oz = (float(v) for v in start + 0.3 * (end - start))
    ax, ay, az = (float(v) for v in along)
    return Joint(
        name=f"{_name(part)}_hinge",
        type="revolute",
        parent=f"side_{part.name[4]}",
        child=_name(part),
        origin=(ox, oy, oz),
        axis=(ax, ay, az),
        position=math.radians(part.angle_deg or 0.0) + turn_rad,
        limits=(-math.pi / 2, 1.5 * math.pi),
        sigma=None,
    )


def test_the_truth_scores_all(shared_dir: Path) -> None:
    frames = [answer_of(frame, 0.0) for frame in read_set(shared_dir / "data" / "labelled")]
    summary = summarize(frames)
    assert [c.category for c in summary.categories] == ["small", "medium", "large", "carton", "cake", "pizza", "all"]
    for figures in summary.categories:
        assert (figures.flap_accuracy_percent, figures.full_accuracy_percent) == (100.0, 100.0)
        assert (figures.false_objects, figures.flaps_wrong) == (0, 0)
        assert figures.usable_flaps_percent == 100.0
        assert figures.tucks_found == figures.tucks_in_cloud
        for spread in (figures.hinge_angle_deg, figures.hinge_distance_mm, figures.flap_angle_deg):
            assert spread.count == figures.flaps_in_cloud
            assert spread.p90 is not None
            assert spread.p90 < 1e-6
    every = summary.category("all")
    assert (every.frames, every.boxes) == (14, 16)
    assert (every.flaps_in_cloud, every.tucks_in_cloud) == (
        _in_cloud(shared_dir, "flap"),
        _in_cloud(shared_dir, "tuck"),
    )
    assert every.flaps_in_cloud > 40


def _in_cloud(shared_dir: Path, kind: str) -> int:
    """Counted from the readings that the truth itself tells."""
    frames = read_set(shared_dir / "data" / "labelled")
    return sum(p.name.startswith(kind) and p.visible_px >= 400 for frame in frames for p in frame.truth.parts)


def test_flaps_that_are_six_degrees_off_are_right_and_not_usable(shared_dir: Path) -> None:
    frames = [answer_of(frame, math.radians(6.0)) for frame in read_set(shared_dir / "data" / "labelled")]
    every = summarize(frames).category("all")
    assert (every.flap_accuracy_percent, every.usable_flaps_percent) == (100.0, 0.0)
    assert every.flap_angle_deg.median is not None
    assert abs(every.flap_angle_deg.median - 6.0) < 1e-9
    assert msgspec.json.decode(msgspec.json.encode(frames), type=list[FrameScore]) == frames
