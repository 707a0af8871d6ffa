"""The exact search from Python: lists, marginals, refusals, and what `infer` tells with it."""

from __future__ import annotations

import numpy as np
import pytest
from inference_problems import random_problems

import boxwright
from boxwright import _core
from boxwright.models import LearnedWeights, load_template, load_weights
from boxwright.simulation import make_frame
from boxwright.types import Cloud


def _carton_problem(segments: int, seed: int) -> tuple[_core.Problem, np.ndarray]:
    template = load_template("carton")
    terms = len(template.feature_names) + len(template.relation_names)
    return next(random_problems(template, segments, 1, seed)), np.ones(terms)


def test_a_list_is_sorted_distinct_and_scores_what_its_features_say() -> None:
    problem, weights = _carton_problem(8, 1)
    rows, scores, status, gap, nodes = problem.solve(weights, k=50)
    assert (status, gap) == ("optimal", 0.0)
    assert nodes > 0
    assert len(np.unique(rows, axis=0)) == 50
    assert np.all(np.diff(scores) <= 0)
    np.testing.assert_allclose(problem.features(rows) @ weights, scores, atol=1e-12)
    assert problem.solve(weights, k=50)[0].tolist() == rows.tolist()


def test_a_spent_budget_is_told() -> None:
    problem, weights = _carton_problem(20, 2)
    best = problem.solve(weights)[1][0]
    _, scores, status, gap, nodes = problem.solve(weights, budget=5)
    assert status == "gap"
    assert nodes <= 6
    assert scores[0] <= best <= scores[0] + gap


def test_marginals_are_those_of_the_scores() -> None:
    problem, weights = _carton_problem(3, 3)
    best, probability, table, error = problem.marginals(weights, 0.5, tolerance=0.0, budget=10**7)
    assert error == 0.0
    np.testing.assert_allclose(table.sum(axis=1), 1.0, atol=1e-12)
    assert 0.0 < probability <= table[np.arange(len(best)), best].min() + 1e-12
    with pytest.raises(ValueError, match="temperature: is -1"):
        problem.marginals(weights, -1.0)


def test_no_numbers_are_refused_by_name() -> None:
    template = load_template("carton")
    features = np.zeros((len(template.feature_names), 4))
    features[2, 1] = np.nan
    relations = np.zeros((len(template.relation_names), 4, 4))
    problem = _core.Problem.of_values(template, features, relations)
    weights = np.ones(len(features) + len(relations))
    with pytest.raises(ValueError, match=f"{template.feature_names[2]}: is NaN for segment 1"):
        problem.solve(weights)
    with pytest.raises(ValueError, match="the template wants"):
        _core.Problem.of_values(template, features, relations[1:])


def test_infer_tells_proof_and_probability(tmp_path) -> None:
    frame = make_frame("carton", seed=2, boxes=1)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    staged = boxwright.infer(cloud, method="paper").model.objects
    exact = boxwright.infer(cloud, method="paper", search={"search": "exact"}).model.objects
    assert staged
    assert exact
    assert all(o.probability is None for o in staged)
    assert exact[0].score >= staged[0].score - 1e-9
    assert all(o.inference.status == "optimal" and o.inference.gap == 0.0 for o in exact)

    cold = tmp_path / "cold.json"
    learned = load_weights("carton")
    LearnedWeights(
        template="carton",
        weights=learned.weights,
        importance=learned.importance,
        accept_score=learned.accept_score,
        temperature=0.005,
    ).save(cold)
    sure = boxwright.infer(
        cloud, method="paper", templates=("carton",), weights=cold, search={"search": "exact"}
    ).model.objects
    assert sure
    assert sure[0].probability is not None
    assert 0.0 < sure[0].probability <= 1.0


def test_search_settings_that_do_not_exist_are_refused() -> None:
    cloud = Cloud(points=np.zeros((1, 3), np.float32), width=1, height=1)
    for search, named in (({"search": "guess"}, "search: "), ({"max_noodles": 3}, ""), ({"max_nodes": "many"}, "")):
        with pytest.raises(ValueError, match=f"^search settings: {named}"):
            boxwright.infer(cloud, method="paper", search=search)


def test_a_search_that_ends_without_a_proof_is_told() -> None:
    frame = make_frame("carton", seed=2, boxes=1)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    search = {"search": "exact", "max_nodes": 0, "max_sweeps": 1}
    model = boxwright.infer(cloud, method="paper", templates=("carton",), search=search).model
    ended = [o.inference for o in model.objects if o.inference.status == "gap"]
    assert ended
    assert all(inference.gap is not None and inference.gap > 0.0 for inference in ended)
    told = [line for line in model.warnings if "without a proof" in line and "raise max_nodes" in line]
    assert len(told) >= len(ended)


def test_weights_of_another_template_are_refused_by_name(tmp_path) -> None:
    path = tmp_path / "weights.json"
    load_weights("cake_box").save(path)
    cloud = Cloud(points=np.zeros((1, 3), np.float32), width=1, height=1)
    with pytest.raises(ValueError, match=r"weights\.json: template: weights of \"cake_box\" do not fit \"carton\""):
        boxwright.infer(cloud, method="paper", templates=("carton",), weights=path)
