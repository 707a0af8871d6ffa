"""Several frames of one scene: what must hold of any, and what they know more than one."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import boxwright
from boxwright.evaluation import score_frame
from boxwright.fusion import Fused
from boxwright.kinematics.transforms import turn_about_line
from boxwright.simulation import Look, make_looks
from boxwright.types import Cloud, Object, PosedCloud

ORIGIN = (0.0, 0.0, 0.0)
SCENES = (("small", 0), ("cake", 4), ("large", 2))
SEED = 31


@cache
def looks_of(category: str, index: int) -> tuple[Look, ...]:
    return make_looks(category, SEED, index, 3, boxes=1)


def cloud_of(look: Look) -> Cloud:
    frame = look.frame
    return Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=ORIGIN)


def posed(looks: tuple[Look, ...], world_from_base: np.ndarray | None = None) -> list[PosedCloud]:
    base = np.eye(4) if world_from_base is None else world_from_base
    return [PosedCloud(cloud=cloud_of(look), base_from_camera=base @ look.base_from_camera) for look in looks]


@cache
def fused_of(category: str, index: int) -> Fused:
    return boxwright.infer_frames(posed(looks_of(category, index)))


def numbers_of(found: Object) -> np.ndarray:
    """All that is told of where and how large an object is."""
    assert found.pose is not None
    corners = [part.corners for part in found.parts if part.corners is not None]
    joints = [(*joint.origin, *joint.axis, joint.position) for joint in found.joints]
    return np.concatenate([np.ravel(corners), np.ravel(joints), found.dimensions or (), found.pose.position])


def test_one_frame_gives_what_infer_gives() -> None:
    looks = looks_of(*SCENES[0])
    alone, fused = boxwright.infer(cloud_of(looks[0])), boxwright.infer_frames(posed(looks[:1]))
    assert fused.model.objects == alone.model.objects
    assert len(alone.model.objects) == 1
    assert np.array_equal(fused.labels[0].object, alone.object_labels)
    assert np.array_equal(fused.labels[0].part, alone.part_labels)


def test_a_wrong_sighting_of_a_box_does_not_lose_it() -> None:
    """One frame has it 107 mm wide instead of 124, with bad odds: a fit to all from there held more readings."""
    looks = make_looks("small", 3101, 6, 3, boxes=1)
    (found,) = boxwright.infer_frames(posed(looks)).model.objects
    true = looks[0].frame.truth.boxes[0].dims
    assert true is not None
    assert found.dimensions is not None
    assert np.abs(np.sort(found.dimensions) - np.sort(true)).max() < 0.006


@pytest.mark.parametrize(("category", "index"), SCENES)
def test_all_frames_together_know_the_box(category: str, index: int) -> None:
    looks, fused = looks_of(category, index), fused_of(category, index)
    objects = np.concatenate([labels.object for labels in fused.labels])
    parts = np.concatenate([labels.part for labels in fused.labels])
    true_labels = np.concatenate([look.frame.labels for look in looks])
    score = score_frame(fused.model.objects, objects, parts, looks[0].frame.truth, true_labels)
    (box,) = score.boxes
    assert (box.flaps_right, box.flaps_wrong) == (box.flaps_in_cloud, 0)
    assert box.dimension_errors_m is not None
    assert max(box.dimension_errors_m) < 0.008
    assert max(error.hinge_distance_m for error in box.flap_errors) < 0.01
    assert all(len(labels.object) == len(look.frame.points) for labels, look in zip(fused.labels, looks, strict=True))


def test_the_base_frame_says_nothing() -> None:
    """Only the cameras' places among each other count."""
    category, index = SCENES[0]
    moved = turn_about_line((0.4, -1.0, 0.3), (0.3, 1.0, 2.0), 2.2)
    again = boxwright.infer_frames(posed(looks_of(category, index), moved))
    (one,), (other,) = fused_of(category, index).model.objects, again.model.objects
    assert np.abs(numbers_of(one) - numbers_of(other)).max() < 1e-4


def test_the_same_frames_give_the_same_bits() -> None:
    category, index = SCENES[1]
    again = boxwright.infer_frames(posed(looks_of(category, index)))
    assert again.model.objects == fused_of(category, index).model.objects


def test_a_part_is_hidden_only_where_every_frame_leaves_it_so() -> None:
    counted = 0
    for category, index in SCENES:
        fused = fused_of(category, index)
        alone = [boxwright.infer(cloud_of(look)).model.objects for look in looks_of(category, index)]
        for found in fused.model.objects:
            hidden = [part for part in found.parts if part.seen_from is not None]
            assert not any(part.observed for part in hidden)
            assert len(hidden) <= min(
                sum(part.seen_from is not None for part in one[0].parts) for one in alone if len(one) == 1
            )
            counted += 1
    assert counted == 3


def test_a_wrong_pose_is_told() -> None:
    """Twenty millimetres and a degree are more than any arm errs by."""
    category, index = SCENES[0]
    frames = posed(looks_of(category, index))
    off = turn_about_line(ORIGIN, (0.0, 1.0, 0.0), np.radians(1.0))
    off[:3, 3] = 0.02, 0.0, 0.0
    frames[2] = PosedCloud(cloud=frames[2].cloud, base_from_camera=frames[2].base_from_camera @ off)
    warnings = boxwright.infer_frames(frames).model.warnings
    assert any(line.startswith("frame 3: ") and "check its pose" in line for line in warnings), warnings
    assert not any("check its pose" in line for line in fused_of(category, index).model.warnings)


def shifted(base_from_camera: np.ndarray, shift_m: tuple[float, float, float]) -> np.ndarray:
    out = base_from_camera.copy()
    out[:3, 3] += shift_m
    return out


def test_poses_that_are_wrong_altogether_are_told() -> None:
    """Swapped, inverted, in another unit, or far off: no frame's box is silently taken for all."""
    frames = posed(looks_of(*SCENES[0]))
    places = [frame.base_from_camera for frame in frames]
    in_another_unit = [shifted(place, tuple(3.0 * place[:3, 3])) for place in places]
    counted = 0
    for wrong in (
        [places[1], places[0], places[2]],
        [np.linalg.inv(place) for place in places],
        in_another_unit,
        [places[0], shifted(places[1], (0.2, 0.1, 0.0)), places[2]],
    ):
        moved = [
            PosedCloud(cloud=frame.cloud, base_from_camera=place) for frame, place in zip(frames, wrong, strict=True)
        ]
        warnings = boxwright.infer_frames(moved).model.warnings
        assert any("check" in line and "pose" in line for line in warnings), (counted, warnings)
        counted += 1
    assert counted == 4


def test_frames_without_an_image_are_refused_by_number() -> None:
    frames = posed(looks_of(*SCENES[0])[:2])
    flat = Cloud(points=frames[1].cloud.points, width=len(frames[1].cloud.points), height=1, viewpoint=ORIGIN)
    frames[1] = PosedCloud(cloud=flat, base_from_camera=frames[1].base_from_camera)
    with pytest.raises(ValueError, match=r"^frame 2: has no image grid"):
        boxwright.infer_frames(frames)
