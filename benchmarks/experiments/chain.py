"""A linear chain of panels, the model of earlier work, and a tree, against the full graph."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import msgspec
import numpy as np
from benchmarks.experiments.accuracy import boxes_of, flap_percent, full_percent, share_percent
from benchmarks.experiments.lab import Lab, model_of
from benchmarks.experiments.left_out import sizes
from benchmarks.experiments.report import Report, Table
from benchmarks.experiments.templates import Spec, built, carton, with_pairs, with_parts
from matplotlib.figure import Figure

from boxwright import _core
from boxwright.evaluation import BoxScore
from boxwright.learning.acceptance import choose_accept_score
from boxwright.models import LearnedWeights

HINGES = {(f"flap_{k}", f"side_{k}") for k in range(4)}
STANDING = {(f"side_{k}", "base") for k in range(4)}
RING = {(f"side_{k}", f"side_{(k + 1) % 4}") for k in range(4)}
CHAINS = {
    "chain of 5: flap, side, base, side, flap": ("flap_0", "side_0", "base", "side_2", "flap_2"),
    "chain of 7: flap, side, base, side, side, side, flap": (
        "flap_0", "side_0", "base", "side_1", "side_2", "side_3", "flap_3",
    ),
}  # fmt: skip
"""No chain along touching panels holds more than seven of the nine: each flap touches its own side alone."""
GRAPHS = {
    "tree: base, four sides, their flaps": HINGES | STANDING,
    "panels that touch": HINGES | STANDING | RING,
}


@dataclass(frozen=True)
class Tested:
    """A model of some of the nine panels, on the test frames."""

    name: str
    parts: int
    ties: int
    boxes: list[BoxScore]
    false_objects: int


def run(lab: Lab) -> Report:
    """Chains, tree, touching panels, and everything."""
    spec = carton()
    tested = [_chain(lab, name, parts) for name, parts in CHAINS.items()]
    tested += [_graph(lab, name, with_pairs(spec, {frozenset(p) for p in pairs})) for name, pairs in GRAPHS.items()]
    tested.append(_graph(lab, "full graph", spec))
    train_count, test_count = sizes(lab)
    columns = ("model", "panels", "ties", "flap %", "full %", "right, of all panels %", "wrong, of all panels %",
               "false objects")  # fmt: skip
    return Report(
        title="A linear chain against the full graph",
        claim="a linear model is unable to express the relations and constraints of a box's structure.",
        how=(
            f"Learned on {train_count} simulated frames, tested on {test_count} others (planes by RANSAC, staged "
            "search). A model has relations between its tied panels alone. A chain leaves out panels, and those "
            "count as missed. The weights of the chains' terms are learned where all sides are alike, on the "
            "graph of touching panels; from which score an assignment is an object is chosen for each."
        ),
        tables=(Table("On the test frames:", columns, [_row(one) for one in tested]),),
        draw=lambda figure: _draw(figure, tested),
        size_in=(8.0, 3.0),
    )


def _graph(lab: Lab, name: str, spec: Spec) -> Tested:
    template = built(spec)
    key = ("whole",) if name == "full graph" else ("graph", name)
    return _tested(lab, name, template, lab.learned(key, template, _training_frames(lab)))


def _chain(lab: Lab, name: str, parts: tuple[str, ...]) -> Tested:
    touching = built(with_pairs(carton(), {frozenset(pair) for pair in GRAPHS["panels that touch"]}))
    common = lab.learned(("graph", "panels that touch"), touching, _training_frames(lab))
    links = {frozenset(pair) for pair in pairwise(parts)}
    template = built(with_parts(with_pairs(carton(), links), parts))
    names = template.feature_names + template.relation_names
    own = msgspec.structs.replace(
        common,
        weights={term: common.weights[term] for term in names},
        importance={term: common.importance[term] for term in names},
    )
    return _tested(lab, name, template, choose_accept_score(template, own, _training_frames(lab)))


def _training_frames(lab: Lab):
    return lab.frames(lab.training, sizes(lab)[0])


def _tested(lab: Lab, name: str, template: _core.Template, learned: LearnedWeights) -> Tested:
    scores = lab.scores([model_of(template, learned)], lab.frames(lab.tests, sizes(lab)[1]))
    false_objects = sum(score.false_objects for score in scores)
    return Tested(name, len(template.parts), len(template.edges), boxes_of(scores), false_objects)


def _row(one: Tested) -> tuple[str | int | float | None, ...]:
    right = share_percent(one.boxes, lambda box: box.panels_right)
    wrong = share_percent(one.boxes, lambda box: box.panels_wrong)
    accuracies = flap_percent(one.boxes), full_percent(one.boxes)
    return (one.name, one.parts, one.ties, *accuracies, right, wrong, one.false_objects)


def _draw(figure: Figure, tested: list[Tested]) -> None:
    axes = figure.subplots()
    y = np.arange(len(tested))
    for k, (label, percent) in enumerate((("flap accuracy", flap_percent), ("full model accuracy", full_percent))):
        values = [percent(one.boxes) for one in tested]
        axes.barh(y + 0.2 * (2 * k - 1), [np.nan if v is None else v for v in values], 0.38, label=label)
    axes.set_yticks(y, [one.name for one in tested])
    axes.invert_yaxis()
    axes.axvline(0.0, color="black", lw=0.6)
    axes.grid(axis="y", visible=False)
    axes.set_xlabel("(right - wrong) / panels in the cloud, mean over boxes (%)")
    axes.legend(loc="lower center", ncols=2, bbox_to_anchor=(0.5, 1.0))
