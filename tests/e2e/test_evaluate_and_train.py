"""`boxwright evaluate`, `train` and `explain`."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import msgspec
import pytest

import boxwright as face
from boxwright.evaluation import load_evaluation
from boxwright.io.models import load_model
from boxwright.learning import LearnedJudgement
from boxwright.models import TEMPLATE_NAMES, load_weights
from support.command import boxwright


def test_evaluate_is_the_same_on_any_number_of_threads(
    scene_set: Path, carton: tuple[str, ...], weights: Path, tmp_path: Path
) -> None:
    for jobs in ("1", "2"):
        path = tmp_path / f"{jobs}.json"
        answer = boxwright("evaluate", scene_set, *carton, "--jobs", jobs, "-o", path)
        assert (answer.status, answer.err) == (0, "")
        assert "86.7" in answer.out, "the paper's figure stands beside ours"
    assert (tmp_path / "1.json").read_bytes() == (tmp_path / "2.json").read_bytes()
    kept = load_evaluation(tmp_path / "1.json")
    assert [frame.name for frame in kept.frames] == ["large_0002", "medium_0001", "small_0000"]
    assert face.evaluate(scene_set, method="paper", templates=("carton",), weights=weights) == kept.summary


def test_a_refused_frame_counts_as_nothing_found(
    scene_set: Path, carton: tuple[str, ...], weights: Path, tmp_path: Path
) -> None:
    folder = tmp_path / "set"
    shutil.copytree(scene_set, folder)
    (folder / "small_0000.pcd").write_bytes(b"no cloud")
    answer = boxwright("evaluate", folder, *carton, "--json")
    assert answer.status == 1
    (line,) = answer.err.splitlines()
    assert "small_0000.pcd" in line
    small = next(row for row in json.loads(answer.out)["categories"] if row["category"] == "small")
    assert (small["frames"], small["boxes"], small["boxes_without_object"]) == (1, 1, 1)
    assert small["full_accuracy_percent"] == 0.0
    with pytest.raises(ValueError, match=r"small_0000\.pcd"):
        face.evaluate(folder, method="paper", templates=("carton",), weights=weights)


def test_weights_are_learned_and_used(scene_set: Path, frame: Path, tmp_path: Path) -> None:
    contents = []
    for jobs in ("1", "2"):
        arguments = ("train", scene_set, "--template", "carton", "-o", "carton.json", "--jobs", jobs)
        answer = boxwright(*arguments, folder=tmp_path)
        assert answer.status == 0, answer.err
        for figure in ("held out", "comes first", "regularizer", "sides_square"):
            assert figure in answer.out
        contents.append(load_weights(tmp_path / "carton.json"))
    first, second = contents
    assert first.weights == second.weights
    assert first.training is not None
    assert first.training.command.startswith(f"boxwright train {scene_set}")
    assert first.training.frames == 3
    used = ("--method", "paper", "--template", "carton", "--weights", tmp_path / "carton.json")
    assert boxwright("infer", frame, "-o", tmp_path / "out", *used).status == 0


def test_the_judgement_is_learned_without_a_refused_frame(tmp_path: Path) -> None:
    boxwright("synth", "boxes", "--count", "4", "--seed", "77", folder=tmp_path)
    boxwright("synth", "none", "--count", "3", "--seed", "78", "--category", "none", folder=tmp_path)
    broken = min((tmp_path / "boxes").glob("*.pcd"))
    broken.write_bytes(b"no cloud")
    answer = boxwright("train", "boxes", "none", "--method", "fitted", "-o", "judgement.json", folder=tmp_path)
    assert answer.status == 1
    assert [line for line in answer.err.splitlines() if broken.name in line] == answer.err.splitlines()
    assert "learned on 6 frames" in answer.out
    learned = msgspec.json.decode((tmp_path / "judgement.json").read_bytes(), type=LearnedJudgement)
    assert learned.training.frames == 6
    assert learned.training.boxes > learned.training.false_boxes > 0


def test_explained_terms_sum_to_the_score(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    answer = boxwright("explain", tmp_path / "small_0000", "--json")
    assert answer.status == 0
    objects = json.loads(answer.out)
    assert objects
    for told in objects:
        terms = told["score_terms"]
        assert sum(term["contribution"] for term in terms) == pytest.approx(told["score"], abs=1e-9)
        assert all(term["contribution"] == pytest.approx(term["weight"] * term["value"]) for term in terms)
    table = boxwright("explain", tmp_path / "small_0000/model.json").out
    assert "Gamma 1" in table
    assert "opposite_sides_rectangular" in table


def test_a_cloud_is_explained_with_what_came_second(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    for search, told_of in (("staged", "the staged search's list"), ("exact", "the exact search's list of all")):
        answer = boxwright("explain", frame, *carton, "--search", search, "--json")
        assert (answer.status, answer.err) == (0, "")
        told = json.loads(answer.out)
        assert told
        for row in told:
            second = row["runner_up"]
            assert (row["search"], row["segments"].keys()) == (search, second["segments"].keys())
            parted = sum(term["contribution"] for term in second["differences"])
            assert parted == pytest.approx(row["score"] - second["score"], abs=1e-9)
        table = boxwright("explain", frame, *carton, "--search", search).out
        for words in (told_of, "where the two differ", "what decided", "--planes ransac"):
            assert words in table
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    assert "boxwright explain CLOUD" in boxwright("explain", tmp_path / "small_0000").out
    refused = boxwright("explain", tmp_path / "small_0000", "--search", "exact")
    assert refused.status == 2
    assert "a model is explained as it stands" in refused.err


def test_the_exact_method_learns_from_few_frames_and_tells_probabilities(
    scene_set: Path, frame: Path, tmp_path: Path
) -> None:
    arguments = ("train", scene_set, "--template", "carton", "--method", "exact", "--prior", "carton")
    answer = boxwright(*arguments, "--leave-one-out", "-o", "carton.json", folder=tmp_path)
    assert answer.status == 0, answer.err
    assert "fitted without it" in answer.out
    learned = load_weights(tmp_path / "carton.json")
    assert learned.training is not None
    assert learned.training.learner == "margin"
    assert len(learned.training.left_out) == 3
    assert learned.temperature is not None
    assert learned.calibration is not None
    used = ("--template", "carton", "--weights", tmp_path / "carton.json", "--method", "exact")
    assert boxwright("infer", frame, "-o", tmp_path / "out", *used).status == 0
    clouds = sorted(scene_set.glob("*.pcd"))
    assert boxwright("infer", *clouds, "-o", tmp_path / "shipped", "--method", "exact").status == 0
    models = [load_model(tmp_path / "shipped" / cloud.stem / "model.json") for cloud in clouds]
    objects = [found for model in models for found in json.loads(msgspec.json.encode(model.objects))]
    assert objects
    for found in objects:
        assert found["inference"] == {
            "status": "optimal",
            "gap": 0.0,
            "alternatives": found["inference"]["alternatives"],
            "unsummed": found["inference"]["unsummed"],
        }
        assert 0.0 <= found["inference"]["unsummed"] <= 1.0
        assert found["probability"] is None or 0.0 < found["probability"] <= 1.0
        told = [part["probability"] for part in found["parts"] if part["observed"]]
        assert all(0.0 < probability < 1.0 for probability in told)
        assert all(part["probability"] is None for part in found["parts"] if not part["observed"])
    refused = boxwright("infer", frame, "-o", tmp_path / "no", "--method", "exact", "--planes", "ransac")
    assert refused.status == 1
    assert "learnt on planes 'grid'" in refused.err
    ridge = boxwright(*arguments, "--learner", "ridge", "-o", "no.json", folder=tmp_path)
    assert ridge.status == 1
    assert "knows no prior" in ridge.err


def test_probabilities_are_fitted_to_labelled_frames(scene_set: Path, tmp_path: Path) -> None:
    answer = boxwright("calibrate", scene_set, "-o", tmp_path)
    assert answer.status == 0, answer.err
    assert "parts judged" in answer.out
    told = [load_weights(tmp_path / f"{name}.json") for name in TEMPLATE_NAMES]
    assert len(told) == 3
    for name, weights in zip(TEMPLATE_NAMES, told, strict=True):
        assert weights.weights == load_weights(name, "exact").weights
        assert weights.calibration == told[0].calibration
    line = told[0].calibration
    assert line is not None
    assert line.rays["marginal"] > 0.0 < line.blind["marginal"]
    empty = tmp_path / "empty"
    empty.mkdir()
    assert boxwright("calibrate", empty, "-o", tmp_path).status == 1
