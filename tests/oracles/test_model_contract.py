"""What the program really says of simulated frames keeps the page's promises.

Weights are set by hand and everything is accepted, so boxes are odd: form is tested here, accuracy is not.
"""

from __future__ import annotations

import io
import json
from pathlib import Path

import jsonschema
import msgspec
import mujoco
import numpy as np
import pytest
import yourdfpy

from boxwright.evaluation import score_frame
from boxwright.io.labels import PointLabels
from boxwright.io.models import load_model, save_model
from boxwright.kinematics import part_corners, urdf_text
from boxwright.kinematics.transforms import Matrix, from_pose
from boxwright.models import load_template
from boxwright.models.weights import LearnedWeights
from boxwright.pipeline import Inferred, infer
from boxwright.simulation import Frame, make_frame
from boxwright.types import Cloud, Model

CASES = (("small", 1), ("carton", 1), ("large", 2), ("pizza", 1), ("none", None))


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> list[tuple[Frame, Inferred]]:
    template = load_template("carton")
    names = template.feature_names + template.relation_names
    weights = LearnedWeights(
        template=template.name,
        weights={name: 1.0 if name.endswith("exists") else -0.3 for name in names},
        importance=dict.fromkeys(names, 1.0),
        accept_score=0.0,
    )
    path = tmp_path_factory.mktemp("weights") / "carton.json"
    weights.save(path)
    frames = [make_frame(category, 6, boxes=boxes) for category, boxes in CASES]
    return [(frame, infer(_cloud(frame), method="paper", templates=("carton",), weights=path)) for frame in frames]


def _cloud(frame: Frame) -> Cloud:
    return Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))


def test_models_fit_the_published_schema_and_survive_their_file(
    answers: list[tuple[Frame, Inferred]], tmp_path: Path
) -> None:
    published = Path(__file__).resolve().parents[2] / "docs" / "schemas" / "model.schema.json"
    schema = jsonschema.Draft202012Validator(json.loads(published.read_text(encoding="utf-8")))
    objects = 0
    for _, inferred in answers:
        save_model(inferred.model, tmp_path / "model.json")
        schema.validate(json.loads((tmp_path / "model.json").read_text(encoding="utf-8")))
        assert load_model(tmp_path / "model.json") == inferred.model
        assert msgspec.json.decode(msgspec.json.encode(inferred.model), type=Model) == inferred.model
        objects += len(inferred.model.objects)
    assert objects >= 4


def test_labels_name_what_the_model_has(answers: list[tuple[Frame, Inferred]]) -> None:
    parts = 0
    for frame, inferred in answers:
        labels = PointLabels(inferred.object_labels, inferred.part_labels)
        assert labels.object.shape == (frame.width * frame.height,)
        for k, model_object in enumerate(inferred.model.objects):
            counts = np.bincount(labels.part[labels.object == k] + 1, minlength=len(model_object.parts) + 1)[1:]
            assert counts.tolist() == [part.points for part in model_object.parts]
            parts += sum(part.observed for part in model_object.parts)
        invalid = ~np.isfinite(frame.points).all(axis=1)
        assert np.all(labels.object[invalid] == -1)
        score = score_frame(inferred.model.objects, labels.object, labels.part, frame.truth, np.ravel(frame.labels))
        assert score.false_objects <= score.objects == len(inferred.model.objects)
    assert parts > 15


def test_every_posed_object_is_a_robot_that_loads(answers: list[tuple[Frame, Inferred]]) -> None:
    count = 0
    for _, inferred in answers:
        for model_object in inferred.model.objects:
            if model_object.pose is None:
                continue
            text = urdf_text(model_object)
            placed = {part.name for part in model_object.parts if part.corners is not None}
            assert set(yourdfpy.URDF.load(io.StringIO(text), load_meshes=False).link_map) == placed
            model = mujoco.MjModel.from_xml_string(text)
            assert {model.body(i).name for i in range(1, model.nbody)} == placed
            count += 1
    assert count >= 4


def test_flaps_at_zero_point_inwards_and_at_a_right_angle_up(answers: list[tuple[Frame, Inferred]]) -> None:
    count = 0
    for _, inferred in answers:
        for model_object in inferred.model.objects:
            if model_object.pose is None:
                continue
            upwards = from_pose(model_object.pose)[:3, 2]
            flaps = [joint for joint in model_object.joints if joint.child.startswith("flap")]
            closed = part_corners(model_object, {joint.name: 0.0 for joint in flaps})
            upright = part_corners(model_object, {joint.name: np.pi / 2 for joint in flaps})
            for joint in flaps:
                axis = np.array(joint.axis)
                inwards = np.cross(upwards, axis) / np.linalg.norm(np.cross(upwards, axis))
                np.testing.assert_allclose(_leaving(closed[joint.child], axis), inwards, atol=1e-9)
                np.testing.assert_allclose(_leaving(upright[joint.child], axis), np.cross(axis, inwards), atol=1e-9)
                count += 1
    assert count >= 6


def _leaving(corners: Matrix, axis: Matrix) -> Matrix:
    """Unit direction, square to the axis, in which a panel leaves its first edge."""
    out = corners[2] + corners[3] - corners[0] - corners[1]
    out = out - (out @ axis) * axis
    return out / np.linalg.norm(out)
