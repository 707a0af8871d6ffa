"""Laws of the figures of merit on frames that are spoilt at random."""

from __future__ import annotations

import itertools
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np
from scipy.optimize import linear_sum_assignment

from boxwright.evaluation import FrameScore, score_frame
from boxwright.evaluation.assignment import assign
from boxwright.types import Joint, Part
from support.labelled_scenes import Scene, perfect_scene, with_names_rotated
from support.random_models import random_angles, random_spec

FRAMES = 80


def spoilt_scene(rng: np.random.Generator) -> Scene:
    """One to three boxes, some panels tiny; parts renamed, hidden, points lost and strayed, hinges moved."""
    boxes = []
    for _ in range(int(rng.integers(1, 4))):
        spec = random_spec(rng)
        names = ["base"] + [f"{kind}_{k}" for kind in ("side", "flap", "tuck") for k in range(4)]
        readings = {name: int(rng.choice([0, 100, 399, 400, 401, 900, 2500])) for name in names}
        boxes.append((spec, random_angles(spec, rng), readings))
    scene = perfect_scene(boxes)
    part_labels, object_labels = scene.part_labels.copy(), scene.object_labels.copy()
    for k in range(len(scene.objects)):
        present = [j for j, part in enumerate(scene.objects[k].parts) if part.observed]
        i, j = rng.choice(present, 2, replace=False)
        mine = object_labels == k
        one, other = mine & (part_labels == i), mine & (part_labels == j)
        part_labels[one] = j
        part_labels[other] = i if rng.uniform() < 0.7 else j
    strayed = rng.uniform(size=len(part_labels)) < rng.uniform(0.0, 0.3)
    source = rng.integers(0, len(part_labels), strayed.sum())
    part_labels[strayed], object_labels[strayed] = part_labels[source], object_labels[source]
    objects = tuple(
        msgspec.structs.replace(
            o, parts=tuple(_spoil_part(p, rng) for p in o.parts), joints=tuple(_spoil_joint(j, rng) for j in o.joints)
        )
        for o in scene.objects
    )
    return replace(scene, objects=objects, part_labels=part_labels, object_labels=object_labels)


def _spoil_part(part: Part, rng: np.random.Generator) -> Part:
    return msgspec.structs.replace(part, observed=part.observed and rng.uniform() < 0.9)


def _spoil_joint(joint: Joint, rng: np.random.Generator) -> Joint:
    x, y, z = (float(v) for v in np.array(joint.origin) + rng.normal(0, 0.01, 3))
    return msgspec.structs.replace(joint, origin=(x, y, z), position=joint.position + float(rng.normal(0, 0.1)))


def nameless(score: FrameScore) -> Any:
    """All of a score but what names the predicted side or counts the rotation."""
    data = msgspec.to_builtins(score)
    for box in data["boxes"]:
        del box["rotation"]
        box["verdicts"] = sorted((v["role"], v["verdict"], v["points"], v["points_on_role"]) for v in box["verdicts"])
        box["flap_errors"] = sorted(box["flap_errors"], key=lambda e: e["flap"])
    return data


def test_scores_do_not_change_under_the_four_rotations() -> None:
    rng = np.random.default_rng(411)
    count = changed = 0
    for _ in range(FRAMES):
        scene = spoilt_scene(rng)
        expected = nameless(scene.score())
        changed += any(box["panels_wrong"] for box in expected["boxes"])
        for k, rotation in itertools.product(range(len(scene.objects)), range(4)):
            assert nameless(with_names_rotated(scene, k, rotation).score()) == expected
            count += 1
    assert count > 4 * FRAMES
    assert changed > FRAMES / 2


def test_scores_do_not_change_under_a_shuffle_of_points_or_objects() -> None:
    rng = np.random.default_rng(412)
    count = 0
    for _ in range(FRAMES):
        scene = spoilt_scene(rng)
        expected = nameless(scene.score())
        order = rng.permutation(len(scene.truth_labels))
        shuffled = score_frame(
            scene.objects,
            scene.object_labels[order],
            scene.part_labels[order],
            scene.truth,
            scene.truth_labels[order],
        )
        assert nameless(shuffled) == expected
        order = rng.permutation(len(scene.objects))
        renumber = np.append(np.argsort(order), -1).astype(np.int16)
        moved = replace(
            scene,
            objects=tuple(scene.objects[i] for i in order),
            object_labels=renumber[scene.object_labels],
        )
        found = nameless(moved.score())
        for box in found["boxes"]:
            box["object"] = None if box["object"] is None else int(order[box["object"]])
        assert found == expected
        count += 1
    assert count == FRAMES


def test_perfect_answers_score_all_whatever_the_box() -> None:
    rng = np.random.default_rng(413)
    count = 0
    for _ in range(FRAMES):
        spec = random_spec(rng)
        score = perfect_scene([(spec, random_angles(spec, rng), {})]).score()
        for box in score.boxes:
            assert box.full_accuracy == 1.0
            assert box.flap_accuracy in (1.0, None)
            assert box.tucks_found == box.tucks_in_cloud
            assert all(max(e.hinge_angle_rad, e.hinge_distance_m, e.flap_angle_rad) < 1e-9 for e in box.flap_errors)
            assert max(box.dimension_errors_m or (1.0,)) < 1e-9
            count += 1
    assert count == FRAMES


def test_the_assignment_is_as_good_as_scipys() -> None:
    rng = np.random.default_rng(414)
    count = 0
    for _ in range(500):
        shape = rng.integers(0, 6, 2)
        shared = rng.integers(0, 5, shape) * rng.integers(0, 1000, shape)
        pairs = assign(shared)
        rows, columns = linear_sum_assignment(shared, maximize=True)
        assert len(set(pairs.values())) == len(pairs)
        assert all(shared[row, column] > 0 for row, column in pairs.items())
        assert sum(shared[row, column] for row, column in pairs.items()) == shared[rows, columns].sum()
        count += 1
    assert count == 500
