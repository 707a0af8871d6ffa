"""Which template a fitted box is of: learning, probabilities, and what the truth says."""

from __future__ import annotations

import json
from pathlib import Path

import msgspec
import numpy as np
import pytest

from boxwright import _core
from boxwright.kinds import true_template
from boxwright.learning.kinds import KindExamples, learn_kinds
from boxwright.models import FITTED_TEMPLATES, TEMPLATE_NAMES, load_kinds, load_object_model
from boxwright.simulation import make_frame
from boxwright.simulation.kinds import FURTHER_KINDS
from boxwright.types import TrueBox, TruePart, Truth

NAMES = tuple(_core.SHAPE_FEATURES)
TRUE = np.random.default_rng(3).normal(0.0, 1.5, (4, len(NAMES)))


def _examples(boxes: int) -> KindExamples:
    """Boxes whose templates are drawn from known weights."""
    rng = np.random.default_rng(7)
    features = rng.normal(0.0, 1.0, (boxes, len(NAMES)))
    features[:, 0] = 1.0
    odds = np.exp(features @ TRUE.T)
    odds /= odds.sum(axis=1, keepdims=True)
    templates = tuple(FITTED_TEMPLATES[rng.choice(4, p=row)] for row in odds)
    return KindExamples(NAMES, features, templates, np.arange(boxes) // 2)


def test_the_fit_is_where_no_weight_could_be_better() -> None:
    examples = _examples(120)
    learned = learn_kinds(examples, "a test")
    assert learned.training is not None
    names = sorted(learned.weights)
    weights = np.array([[learned.weights[name][feature] for feature in NAMES] for name in names])
    truth = np.array([names.index(name) for name in examples.templates])
    spread = np.where(examples.features.std(axis=0) == 0, 1.0, examples.features.std(axis=0))

    def objective(w: np.ndarray) -> float:
        scores = examples.features @ w.T
        right = scores[np.arange(len(truth)), truth]
        penalty = 0.5 * learned.training.regularizer * float(((w * spread) ** 2).sum())
        return float(np.mean(np.log(np.exp(scores).sum(axis=1)) - right)) + penalty

    checked = 0
    for index in np.ndindex(weights.shape):
        step = np.zeros_like(weights)
        step[index] = 1e-4
        slope = (objective(weights + step) - objective(weights - step)) / 2e-4
        assert abs(slope) < 1e-4, f"{names[index[0]]}, {NAMES[index[1]]}: the objective still falls by {slope}"
        checked += 1
    assert checked == 4 * len(NAMES)
    assert learned.training.held_out_accuracy > 0.6


def test_same_boxes_give_the_same_weights_and_a_file_the_core_reads(tmp_path: Path) -> None:
    learned = [learn_kinds(_examples(60), "a test") for _ in range(2)]
    assert learned[0] == learned[1]
    learned[0].save(tmp_path / "kinds.json")
    load_kinds(tmp_path / "kinds.json")
    text = (tmp_path / "kinds.json").read_text(encoding="utf-8")
    (tmp_path / "kinds.json").write_text(text.replace("log_base", "colour"), encoding="utf-8")
    with pytest.raises(ValueError, match=r"kinds.json: weights.\w+: \"colour\" is no feature"):
        load_kinds(tmp_path / "kinds.json")


def test_too_little_is_refused() -> None:
    examples = _examples(60)
    one = np.array([name == "tote" for name in examples.templates])
    with pytest.raises(ValueError, match="of 1 templates"):
        learn_kinds(examples.of(one), "a test")


def test_shipped_weights_know_the_shipped_templates() -> None:
    load_kinds()
    path = Path(_core.__file__).parent / "models/weights/fitted/kinds.json"
    assert set(json.loads(path.read_text(encoding="utf-8"))["weights"]) == set(FITTED_TEMPLATES)


def test_a_tote_is_no_template_of_the_paper() -> None:
    assert set(FITTED_TEMPLATES) - set(TEMPLATE_NAMES) == {"tote"}
    template, _ = load_object_model("tote", shipped="exact")
    assert template.parts == ["base", "side_0", "side_1", "side_2", "side_3"]
    with pytest.raises(ValueError, match="no weights are shipped for 'tote'"):
        load_object_model("tote", shipped="ransac")


CORNERS = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0))


@pytest.mark.parametrize(
    ("category", "parts", "template"),
    [
        ("small", {"flap0": 900}, "carton"),
        ("small", {"flap0": 0}, "carton"),
        ("small", {"flap0": 900, "tuck0": 400}, "cake_box"),
        ("small", {"flap0": 900, "tuck0": 399}, "carton"),
        ("cake", {"flap2": 900}, "cake_box"),
        ("pizza", {"flap2": 900, "tuck2": 900}, "pizza_box"),
        ("medium", {}, "tote"),
        ("tote", {"flap0": 900}, "tote"),
    ],
)
def test_the_truth_names_a_template(category: str, parts: dict[str, int], template: str) -> None:
    panels = tuple(TruePart(0, name, None, False, None, CORNERS, seen) for name, seen in {"side0": 9, **parts}.items())
    other = TruePart(1, "tuck1", None, False, None, CORNERS, 5000)
    boxes = (TrueBox(0, category, "any", None), TrueBox(1, "pizza", "any", None))
    truth = Truth("frame", category, None, (0.0, 0.0, 1.0), boxes, (*panels, other))
    assert true_template(truth, 0) == template


def test_totes_are_drawn_where_they_are_named() -> None:
    variants = {make_frame("tote", 5, index, boxes=1, clutter=False).truth.boxes[0].variant for index in range(4)}
    assert variants == set(FURTHER_KINDS["tote"])
    frame = make_frame("tote", 5, 0, boxes=1, clutter=False)
    assert msgspec.to_builtins(frame.truth)["category"] == "tote"
