"""Figures of merit on frames whose scores are counted by hand."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from boxwright.evaluation import (
    Answer,
    BoxScore,
    FrameScore,
    LabelledFrame,
    load_evaluation,
    make_evaluation,
    save_evaluation,
    score_set,
    summarize,
)
from boxwright.io.labels import PointLabels
from boxwright.types import Object
from support.labelled_scenes import Scene, perfect_scene, with_names_rotated
from support.random_models import Angles, BoxSpec, Flap


def carton(tuck: bool = False) -> tuple[BoxSpec, Angles]:
    """40 x 30 x 20 cm, four flaps of 15 cm, a tuck on flap 1 if asked for; box frame = input's frame."""
    corners = np.array([[-0.2, -0.15], [0.2, -0.15], [0.2, 0.15], [-0.2, 0.15]])
    flaps = tuple(Flap(k, 0.15, 0.0, 0.0, 0.05 if tuck and k == 1 else None) for k in range(4))
    spec = BoxSpec(corners, 0.2, flaps, np.eye(3), np.zeros(3), (0.0, 0.0, 0.0, 1.0), True, True, 0.004)
    angles = {f"flap_{k}": math.radians(100 + 20 * k) for k in range(4)}
    return spec, {**angles, "tuck_1": 0.5} if tuck else angles


def scene_of(readings: dict[str, int] | None = None, boxes: int = 1, tuck: bool = False) -> Scene:
    spec, angles = carton(tuck)
    return perfect_scene([(spec, angles, readings or {})] * boxes)


def relabelled(scene: Scene, name: str, new_name: str, k: int = 0) -> Scene:
    """Points of part `name` of object k go to `new_name`."""
    names = [part.name for part in scene.objects[k].parts]
    chosen = (scene.object_labels == k) & (scene.part_labels == names.index(name))
    return replace(scene, part_labels=np.where(chosen, np.int16(names.index(new_name)), scene.part_labels))


def swapped(scene: Scene, one: str, other: str) -> Scene:
    names = [part.name for part in scene.objects[0].parts]
    i, j = names.index(one), names.index(other)
    swap = np.where(scene.part_labels == i, j, np.where(scene.part_labels == j, i, scene.part_labels))
    return replace(scene, part_labels=swap.astype(np.int16))


def with_object(scene: Scene, **changes: object) -> Scene:
    return replace(scene, objects=(msgspec.structs.replace(scene.objects[0], **changes), *scene.objects[1:]))


def with_observed(scene: Scene, name: str, observed: bool) -> Scene:
    parts = [msgspec.structs.replace(p, observed=observed) if p.name == name else p for p in scene.objects[0].parts]
    return with_object(scene, parts=tuple(parts))


def only(score: FrameScore) -> BoxScore:
    (box,) = score.boxes
    return box


def test_the_truth_scores_all() -> None:
    score = scene_of(tuck=True).score()
    box = only(score)
    assert (box.flaps_in_cloud, box.flaps_right, box.flaps_wrong) == (4, 4, 0)
    assert (box.panels_in_cloud, box.panels_right, box.panels_wrong) == (9, 9, 0)
    assert (box.tucks_in_cloud, box.tucks_found, box.tucks_wrong) == (1, 1, 0)
    assert (box.object, box.rotation, box.missed, score.false_objects) == (0, 0, (), 0)
    for error in box.flap_errors:
        assert max(error.hinge_angle_rad, error.hinge_distance_m, error.flap_angle_rad) < 1e-12
    assert box.dimension_errors_m == pytest.approx((0, 0, 0), abs=1e-12)
    figures = summarize([score]).category("all")
    assert (figures.flap_accuracy_percent, figures.full_accuracy_percent) == (100.0, 100.0)
    assert (figures.usable_flaps_percent, figures.tucks_found, figures.tucks_in_cloud) == (100.0, 1, 1)
    assert figures.hinge_angle_deg.count == 4


def test_two_swapped_flaps_are_two_wrong() -> None:
    box = only(swapped(scene_of(), "flap_0", "flap_2").score())
    assert (box.flaps_right, box.flaps_wrong, box.panels_right, box.panels_wrong) == (2, 2, 7, 2)
    assert (box.flap_accuracy, box.full_accuracy) == (0.0, pytest.approx(5 / 9))
    assert box.missed == ("flap_0", "flap_2")
    wrong = [v for v in box.verdicts if v.verdict == "wrong"]
    assert [(v.name, v.mostly_on) for v in wrong] == [("flap_0", "flap_2"), ("flap_2", "flap_0")]


def test_a_flap_that_is_not_observed_is_missed_and_not_wrong() -> None:
    box = only(with_observed(scene_of(), "flap_3", False).score())
    assert (box.flaps_right, box.flaps_wrong, box.flap_accuracy, box.missed) == (3, 0, 0.75, ("flap_3",))


@pytest.mark.parametrize("rotation", [0, 1, 2, 3])
def test_the_four_rotations_are_the_same_box(rotation: int) -> None:
    box = only(with_names_rotated(scene_of(), 0, rotation).score())
    assert (box.rotation, box.flap_accuracy, box.full_accuracy) == (rotation, 1.0, 1.0)
    assert box.dimension_errors_m == pytest.approx((0, 0, 0), abs=1e-12)
    assert {error.flap for error in box.flap_errors} == {f"flap_{k}" for k in range(4)}
    assert max(error.flap_angle_rad for error in box.flap_errors) < 1e-12


def test_half_of_the_points_and_half_of_the_readings_are_enough_and_less_is_not() -> None:
    for taken, right in ((1500, True), (1501, False)):
        scene = scene_of()
        names = [part.name for part in scene.objects[0].parts]
        mine = np.flatnonzero(scene.part_labels == names.index("flap_0"))
        part_labels = scene.part_labels.copy()
        part_labels[mine[:taken]] = -1
        assert only(replace(scene, part_labels=part_labels).score()).flaps_right == (4 if right else 3)
    for added, right in ((3000, True), (3001, False)):
        scene = scene_of()
        names = [part.name for part in scene.objects[0].parts]
        background = np.flatnonzero(scene.truth_labels == 0)
        object_labels, part_labels = scene.object_labels.copy(), scene.part_labels.copy()
        object_labels[background[:added]] = 0
        part_labels[background[:added]] = names.index("flap_0")
        box = only(replace(scene, object_labels=object_labels, part_labels=part_labels).score())
        assert (box.flaps_right, box.flaps_wrong) == ((4, 0) if right else (3, 1))


def test_a_panel_under_400_readings_is_neither() -> None:
    for readings, in_cloud in ((400, 4), (399, 3)):
        box = only(scene_of({"flap_1": readings}).score())
        assert (box.flaps_in_cloud, box.flaps_right, box.flaps_wrong) == (in_cloud, in_cloud, 0)
        verdict = next(v.verdict for v in box.verdicts if v.name == "flap_1")
        assert verdict == ("right" if in_cloud == 4 else "neither")


def test_a_part_elsewhere_is_wrong_though_its_panel_is_tiny() -> None:
    box = only(relabelled(scene_of({"flap_1": 100}), "flap_2", "flap_1").score())
    assert (box.flaps_in_cloud, box.flaps_right, box.flaps_wrong) == (3, 2, 2)
    assert {v.name for v in box.verdicts if v.verdict == "wrong"} == {"flap_1", "flap_2"}


def test_a_flap_that_the_truth_does_not_have_is_wrong() -> None:
    scene = scene_of()
    parts = tuple(part for part in scene.truth.parts if part.name != "flap3")
    labels = np.where(scene.truth_labels > len(parts), 0, scene.truth_labels).astype(np.uint16)
    assert scene.truth.parts[-1].name == "flap3"
    box = only(replace(scene, truth=msgspec.structs.replace(scene.truth, parts=parts), truth_labels=labels).score())
    assert (box.flaps_in_cloud, box.flaps_right, box.flaps_wrong) == (3, 3, 1)


def test_tucks_touch_no_accuracy() -> None:
    scene = scene_of(tuck=True)
    box = only(with_observed(scene, "tuck_1", False).score())
    assert (box.tucks_found, box.tucks_in_cloud, box.flap_accuracy, box.full_accuracy) == (0, 1, 1.0, 1.0)
    box = only(swapped(scene, "tuck_1", "flap_1").score())
    assert (box.tucks_found, box.tucks_wrong, box.flaps_right, box.flaps_wrong) == (0, 1, 3, 1)


def test_a_box_without_an_object_scores_0() -> None:
    scene = scene_of(boxes=2)
    lost = scene.object_labels == 1
    lone = replace(
        scene,
        objects=scene.objects[:1],
        object_labels=np.where(lost, np.int16(-1), scene.object_labels),
        part_labels=np.where(lost, np.int16(-1), scene.part_labels),
    )
    score = lone.score()
    assert [box.object for box in score.boxes] == [0, None]
    assert (score.boxes[1].flap_accuracy, score.boxes[1].full_accuracy) == (0.0, 0.0)
    figures = summarize([score]).category("small")
    assert (figures.flap_accuracy_percent, figures.full_accuracy_percent) == (50.0, 50.0)
    assert (figures.usable_flaps_percent, figures.boxes_without_object) == (50.0, 1)


def test_objects_go_to_boxes_by_shared_points_whatever_their_order() -> None:
    scene = scene_of(boxes=2)
    other = np.array([1, 0, -1], np.int16)[scene.object_labels]
    score = replace(scene, object_labels=other).score()
    assert [box.object for box in score.boxes] == [1, 0]
    assert summarize([score]).category("all").full_accuracy_percent == 100.0


def test_an_object_left_over_is_false() -> None:
    scene = scene_of()
    background = np.flatnonzero(scene.truth_labels == 0)
    object_labels = scene.object_labels.copy()
    object_labels[background[:100]] = 1
    score = replace(scene, objects=scene.objects * 2, object_labels=object_labels).score()
    assert (score.objects, score.false_objects, len(score.boxes)) == (2, 1, 1)
    assert only(score).full_accuracy == 1.0


def test_a_box_under_6000_readings_is_neither_asked_for_nor_false() -> None:
    names = ["base", *(f"{kind}_{k}" for kind in ("side", "flap") for k in range(4))]
    few = dict.fromkeys(names, 666) | {"base": 671}
    score = scene_of(few).score()
    assert (score.objects, score.false_objects, score.boxes) == (1, 0, ())
    few["base"] += 1
    assert only(scene_of(few).score()).full_accuracy == 1.0


def test_hinge_and_angle_errors_are_what_was_added() -> None:
    scene = scene_of()
    joints = list(scene.objects[0].joints)
    tilt, shift, turn = math.radians(2.0), 0.006, math.radians(4.0)
    # flap_0's hinge runs along +x: its line turned by `tilt` about its middle, moved up, its angle too large
    joints[0] = msgspec.structs.replace(
        joints[0],
        axis=(math.cos(tilt), math.sin(tilt), 0.0),
        origin=(joints[0].origin[0], joints[0].origin[1], joints[0].origin[2] + shift),
        position=joints[0].position + turn,
    )
    # flap_1's hinge is told backwards, flap_2 slides along its own line, flap_3 has no hinge
    joints[1] = msgspec.structs.replace(joints[1], axis=(0.0, -1.0, 0.0))
    x, y, z = joints[2].origin
    joints[2] = msgspec.structs.replace(joints[2], origin=(x + 0.05, y, z))
    score = with_object(scene, joints=tuple(joints[:3])).score()
    first, second, third = only(score).flap_errors
    assert (first.flap, first.hinge_angle_rad, first.hinge_distance_m, first.flap_angle_rad) == pytest.approx(
        ("flap_0", tilt, shift, turn)
    )
    assert second.hinge_angle_rad == pytest.approx(math.pi)
    assert third.hinge_distance_m == pytest.approx(0.0, abs=1e-12)
    figures = summarize([score]).category("all")
    assert figures.usable_flaps_percent == 50.0
    assert figures.hinge_angle_deg.count == 3
    assert figures.hinge_angle_deg.median == pytest.approx(2.0)
    assert figures.hinge_angle_deg.p90 == pytest.approx(2.0 + 0.8 * 178.0)
    assert figures.hinge_distance_mm.median == pytest.approx(0.0, abs=1e-9)
    assert figures.flap_angle_deg.p90 == pytest.approx(0.8 * 4.0)


def test_dimensions_are_compared_under_the_rotation() -> None:
    scene = with_object(scene_of(), dimensions=(0.41, 0.28, 0.203))
    for rotation in range(4):
        box = only(with_names_rotated(scene, 0, rotation).score())
        assert box.dimension_errors_m == pytest.approx((0.01, 0.02, 0.003))
    assert only(with_object(scene, dimensions=None).score()).dimension_errors_m is None


def test_frames_without_boxes_and_without_objects_have_no_accuracy() -> None:
    empty = replace(
        scene_of(),
        truth=msgspec.structs.replace(scene_of().truth, category="none", boxes=(), parts=()),
        truth_labels=np.zeros_like(scene_of().truth_labels),
    )
    score = empty.score()
    assert (score.false_objects, score.boxes) == (1, ())
    summary = summarize([score, scene_of().score()])
    assert [c.category for c in summary.categories] == ["small", "none", "all"]
    assert summary.category("none").flap_accuracy_percent is None
    assert (summary.category("none").false_objects, summary.category("small").false_objects) == (1, 0)
    assert (summary.category("all").false_objects, summary.category("all").full_accuracy_percent) == (1, 100.0)
    assert summarize([]).category("all").frames == 0


def test_a_box_without_flaps_in_the_cloud_has_no_flap_accuracy() -> None:
    bare = scene_of({f"flap_{k}": 0 for k in range(4)})
    observed: Object = bare.objects[0]
    for k in range(4):
        bare = with_observed(bare, f"flap_{k}", False)
    assert observed.part("flap_0").observed
    score = bare.score()
    assert (only(score).flap_accuracy, only(score).full_accuracy) == (None, 1.0)
    figures = summarize([score, scene_of().score()]).category("all")
    assert (figures.flap_accuracy_percent, figures.boxes) == (100.0, 2)


def test_a_part_of_a_foreign_kind_is_wrong() -> None:
    scene = scene_of()
    parts = tuple(msgspec.structs.replace(p, name="lid") if p.name == "side_3" else p for p in scene.objects[0].parts)
    joints = tuple(j for j in scene.objects[0].joints if j.parent != "side_3")
    box = only(with_object(scene, parts=parts, joints=joints).score())
    assert (box.panels_right, box.panels_wrong, box.missed) == (8, 1, ("side_3",))


def test_a_set_is_scored_and_kept_as_a_file(tmp_path: Path) -> None:
    scene = swapped(scene_of(), "flap_0", "flap_1")
    frame = LabelledFrame(name="made_up", cloud_path=Path("made_up.pcd"), truth=scene.truth, labels=scene.truth_labels)
    answer = Answer(objects=scene.objects, labels=PointLabels(scene.object_labels, scene.part_labels))
    asked: list[Path] = []

    def method(cloud_path: Path) -> Answer:
        asked.append(cloud_path)
        return answer

    evaluation = make_evaluation("paper", "made_up", score_set([frame, frame], method))
    assert asked == [Path("made_up.pcd")] * 2
    assert evaluation.frames == (scene.score(),) * 2
    assert evaluation.summary.category("all").flap_accuracy_percent == 0.0
    save_evaluation(evaluation, tmp_path / "evaluation.json")
    assert load_evaluation(tmp_path / "evaluation.json") == evaluation


def test_results_are_files() -> None:
    score = swapped(scene_of(boxes=2), "flap_0", "side_1").score()
    assert msgspec.json.decode(msgspec.json.encode(score), type=FrameScore) == score
    summary = summarize([score])
    assert msgspec.json.decode(msgspec.json.encode(summary), type=type(summary)) == summary


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"truth_labels": np.zeros(7, np.uint16)}, "one entry for each point"),
        ({"objects": ()}, "object labels go to 0; there are 0 objects"),
    ],
)
def test_labels_that_do_not_fit_are_refused(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        replace(scene_of(), **change).score()
    scene = scene_of()
    with pytest.raises(ValueError, match="part labels of object 0 go to 99"):
        replace(scene, part_labels=np.where(scene.part_labels == 3, np.int16(99), scene.part_labels)).score()
    with pytest.raises(ValueError, match="true labels go to 50"):
        replace(scene, truth_labels=np.full_like(scene.truth_labels, 50)).score()
