"""`boxwright explain` of what the default method answers; that of assignments is in test_evaluate_and_train.py."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import numpy as np
import pytest

from boxwright.io.models import load_model
from boxwright.simulation import make_frame
from support.command import boxwright


def test_whole_boxes_are_explained_of_the_cloud_as_of_the_model(scene_set: Path, tmp_path: Path) -> None:
    clouds = sorted(scene_set.glob("*.pcd"))
    assert boxwright("infer", *clouds, "-o", tmp_path).status == 0
    cases = 0
    for cloud in clouds:
        answer = boxwright("explain", cloud, "--json")
        assert (answer.status, answer.err) == (0, "")
        told = json.loads(answer.out)
        objects = load_model(tmp_path / cloud.stem / "model.json").objects
        for one, found in zip(told, objects, strict=True):
            assert one.keys() == {"template", "score", "score_terms"}
            assert (one["template"], one["score"]) == (found.template, found.score)
            assert one["score_terms"] == list(msgspec.to_builtins(found.score_terms))
            assert {term["kind"] for term in one["score_terms"]} == {"evidence"}
            assert sum(term["contribution"] for term in one["score_terms"]) == pytest.approx(found.score, abs=1e-9)
            assert found.probability == pytest.approx(1.0 / (1.0 + np.exp(-found.score)), abs=1e-9)
            cases += 1
        assert json.loads(boxwright("explain", tmp_path / cloud.stem, "--json").out) == told
    assert cases == 3


def test_the_table_of_whole_boxes_says_what_the_score_is(frame: Path, tmp_path: Path) -> None:
    assert boxwright("infer", frame, "-o", tmp_path).status == 0
    for source in (frame, tmp_path / "small_0000"):
        table = boxwright("explain", source).out
        for words in ("on_walls", "trees", "log odds", "eq. 90", "None came second"):
            assert words in table
        for words in ("boxwright explain CLOUD", "--planes", "what decided"):
            assert words not in table


@pytest.mark.parametrize("search", ["exact", "staged"])
def test_a_search_that_whole_boxes_do_not_have_is_refused(search: str, frame: Path) -> None:
    answer = boxwright("explain", frame, "--search", search)
    assert answer.status == 2
    error = " ".join(answer.err.replace("│", " ").split())
    assert "--search: with an image and a viewpoint the method fitted judges whole boxes" in error
    assert "add --method exact or paper" in error


def _without_image(category: str, seed: int, folder: Path) -> Path:
    """The readings of a simulated frame of one box as an unorganized cloud."""
    points = make_frame(category, seed, 0, boxes=1, clutter=False).points
    path = folder / f"{category}.npy"
    np.save(path, points[np.isfinite(points).all(axis=1)])
    return path


def test_a_cloud_without_an_image_is_explained_as_an_assignment(tmp_path: Path) -> None:
    cases = 0
    for category, seed in (("large", 3), ("carton", 5)):
        answer = boxwright("explain", _without_image(category, seed, tmp_path), "--json", "--search", "exact")
        assert answer.status == 0, answer.err
        assert f"{category}.npy: warning: " in answer.err
        for told in json.loads(answer.out):
            second = told["runner_up"]
            parted = sum(term["contribution"] for term in second["differences"])
            assert parted == pytest.approx(told["score"] - second["score"], abs=1e-9)
            assert "evidence" not in {term["kind"] for term in told["score_terms"]}
            cases += 1
    assert cases == 2


def test_a_fit_that_has_not_converged_is_no_object_and_told(tmp_path: Path) -> None:
    answer = boxwright("infer", _without_image("small", 3, tmp_path), "-o", tmp_path, "--json", "--verbose")
    assert answer.status == 0, answer.err
    (told,) = json.loads(answer.out)
    assert told["objects"] == []
    assert told["refused"] == ["no object of carton: it had not converged after 60 steps"]


def test_a_box_that_its_shape_tells_anew_says_that_its_terms_are_gone(tmp_path: Path) -> None:
    cloud = _without_image("tote", 12, tmp_path)
    assert boxwright("infer", cloud, "-o", tmp_path / "out").status == 0
    for source in (cloud, tmp_path / "out/tote"):
        answer = boxwright("explain", source)
        assert answer.status == 0, answer.err
        assert "object 0: tote, score" in answer.out
        assert "the other's terms, which made the score, are not kept" in answer.out
    (told,) = json.loads(boxwright("explain", cloud, "--json").out)
    assert told["score_terms"] == []


HELP = (
    ("explain", "the score is the log odds that this is a box"),
    ("explain", "the score is J(G) of the assignment"),
    ("infer", "why candidates were refused"),
    ("infer", "fitted, exact: grid; paper: ransac"),
)


@pytest.mark.parametrize(("command", "words"), HELP)
def test_help_says_what_a_user_will_see(command: str, words: str) -> None:
    text = boxwright(command, "--help").out
    assert words in " ".join(text.replace("│", " ").split())
