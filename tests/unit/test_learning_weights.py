"""Weights that do not fit are refused with one line that names file, key and mend."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from boxwright.models import LearnedWeights, load_object_model, load_template, load_weights

Change = Callable[[dict[str, Any]], Any]

MISFITS: tuple[tuple[Change, str], ...] = (
    (
        lambda d: d.update(template="pizza_box"),
        'template: weights of "pizza_box" do not fit "carton"; name the weights',
    ),
    (lambda d: d.update(format="boxwright.model"), 'format: is "boxwright.model" version 1; weights say'),
    (lambda d: d.update(version=2), 'format: is "boxwright.weights" version 2; weights say'),
    (lambda d: d["weights"].pop("sides_meet"), 'weights: "sides_meet" is missing; train again'),
    (lambda d: d["importance"].pop("base_level"), 'importance: "base_level" is missing; train again'),
    (
        lambda d: d["weights"].update(lid=1.0),
        'weights: "lid" is no feature or relation of "carton"; its names are base',
    ),
    (lambda d: d["importance"].update(lid=1.0), 'importance: "lid" is no feature or relation of "carton"; its names'),
    (lambda d: d["weights"].update(sides_meet=None), "invalid type: null, expected f64 at line 1 column"),
    (lambda d: d["weights"].update(sides_meet="much"), 'invalid type: string "much", expected f64 at line 1 column'),
    (lambda d: d["weights"].update(sides_meet=float("nan")), "expected value at line 1 column"),
    (lambda d: d["weights"].update(sides_meet=float("inf")), "expected value at line 1 column"),
    (lambda d: d.update(accept_score=float("nan")), "expected value at line 1 column"),
    (lambda d: d.pop("accept_score"), "missing field `accept_score`"),
    (lambda d: d.pop("weights"), "missing field `weights`"),
    (lambda d: d.pop("template"), "missing field `template`"),
)


def fitting() -> dict[str, Any]:
    template = load_template("carton")
    names = template.feature_names + template.relation_names
    return {
        "format": "boxwright.weights",
        "version": 1,
        "template": "carton",
        "weights": dict.fromkeys(names, 0.5),
        "importance": dict.fromkeys(names, 1.0),
        "accept_score": 0.2,
    }


def refusal(path: Path) -> str:
    with pytest.raises(ValueError, match=r"carton\.json") as caught:
        load_object_model("carton", path)
    text = str(caught.value)
    assert "\n" not in text
    assert text.startswith(f"{path}: ")
    return text.removeprefix(f"{path}: ")


def test_weights_that_fit_are_taken(tmp_path: Path) -> None:
    path = tmp_path / "carton.json"
    path.write_text(json.dumps(fitting()))
    template, _ = load_object_model("carton", path)
    assert template.name == "carton"
    np.testing.assert_array_equal(load_weights(path).vector(template), 0.5)


def test_every_misfit_names_its_key(tmp_path: Path) -> None:
    path, cases = tmp_path / "carton.json", 0
    for change, told in MISFITS:
        data = fitting()
        change(data)
        path.write_text(json.dumps(data))
        text = refusal(path)
        assert text.startswith(told), text
        cases += 1
    assert cases == len(MISFITS) == 15


@pytest.mark.parametrize("text", ["", "{", "[]", "null", "weights", '{"weights": 1e999}'])
def test_what_is_no_weights_file_is_refused(tmp_path: Path, text: str) -> None:
    path = tmp_path / "carton.json"
    path.write_text(text)
    assert refusal(path).endswith("boxwright train writes weights that fit")
    with pytest.raises(ValueError, match="boxwright train writes weights that fit"):
        load_weights(path)


def test_a_number_beyond_all_bounds_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "carton.json"
    path.write_text(json.dumps(fitting()).replace('"sides_meet": 0.5', '"sides_meet": 1e999', 1))
    assert "number out of range" in refusal(path)


def test_weights_survive_their_file(tmp_path: Path) -> None:
    data = fitting()
    weights = LearnedWeights(
        template="carton", weights=data["weights"], importance=data["importance"], accept_score=0.1 + 0.2
    )
    weights.save(tmp_path / "carton.json")
    assert load_weights(tmp_path / "carton.json") == weights
    load_object_model("carton", tmp_path / "carton.json")
