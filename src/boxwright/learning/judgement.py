"""Learns how a fitted box, and each of its panels, is judged: weights mended by trees (docs/maths.md, eq. 90)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation import Answer, BoxScore, LabelledFrame, SetEntry, read_entry, score_answer
from boxwright.io.clouds import read_cloud
from boxwright.io.labels import PointLabels
from boxwright.learning.boosting import Tree, fit_trees, require_learner
from boxwright.models import load_object_model
from boxwright.parallel import ordered_map
from boxwright.types.model import Object

RIDGE = 100.0
"""Weight of the squared coefficients, of features scaled to a spread of 1, against one example."""
STEPS = 60
TOLD_FROM = 0.3
"""Boxes are told that have this probability or more: the frames hold more that is none than those of a packing cell."""
PART_TOLD_FROM = 0.5
"""The same of panels."""
LYING_TOLD_FROM = 0.8
"""The same of boxes that lie on a side: the frames hold more of them than the world, and few shelves."""
SMALL_TOLD_FROM = 0.8
"""The same of boxes that are smaller than nearly all right ones that were learnt from: there the odds are a guess."""
SMALL_SHARE = 0.01
"""So many of the right ones are smaller."""
DOUBTFUL_TOLD_FROM = 0.7
"""The same of boxes of which no inside is seen, as of stacked blocks, or a side is looked through, as of folders."""
INSIDE_READINGS = 100.0
"""Fewer on inner faces are no inside: as much is asked of what may be closed (core/src/open_box/closed.rs)."""
SIDE_ABSENT = 0.9
"""So probable is it that a side is not there where more is asked of the box."""
UNIT_READINGS = 400.0
"""Features tell readings in this unit, by the logarithm of one more."""
RIGHT_SHARE = 0.25
"""A box is right when its right less its wrong panels are at least this share of those in the cloud."""

_OBJECT = msgspec.json.Decoder(Object)


class Features(msgspec.Struct, frozen=True):
    """What one object, and each of its parts, is judged by, by name."""

    box: dict[str, float]
    parts: dict[str, dict[str, float]]


_FEATURES = msgspec.json.Decoder(Features)


class JudgementReport(msgspec.Struct, frozen=True, kw_only=True):
    """How a judgement came to be."""

    command: str
    frames: int
    boxes: int
    false_boxes: int
    parts: int
    wrong_parts: int


class Doubt(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """From which probability on boxes are told of which a feature is less, or more, than a bound."""

    feature: str
    told_from: float
    below: float | None = None
    above: float | None = None


class Odds(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Log odds: the weighted sum of the features, and what each tree adds."""

    weights: dict[str, float]
    trees: list[Tree]
    told_from: float
    """Told is what has this probability or more."""
    doubts: tuple[Doubt, ...] = ()
    """Where more is asked."""


class LearnedJudgement(msgspec.Struct, frozen=True, kw_only=True):
    """How a box and a part are judged (`boxwright.judgement`, version 4); boxes on a side by odds of their own."""

    box: Odds
    lying: Odds
    part: Odds
    training: JudgementReport
    format: Literal["boxwright.judgement"] = "boxwright.judgement"
    version: Literal[4] = 4

    def save(self, path: str | Path) -> None:
        """Writes it as JSON, each tree on a line."""
        box, lying, part = (msgspec.structs.replace(odds, trees=[]) for odds in (self.box, self.lying, self.part))
        told = msgspec.json.encode(msgspec.structs.replace(self, box=box, lying=lying, part=part))
        text = msgspec.json.format(told, indent=1).decode()
        for odds in (self.box, self.lying, self.part):
            lines = ",\n".join(f"   {msgspec.json.encode(tree).decode()}" for tree in odds.trees)
            text = text.replace('"trees": []', f'"trees": [\n{lines}\n  ]', 1)
        Path(path).write_text(text + "\n", encoding="utf-8")


class Examples(msgspec.Struct, frozen=True):
    """Of one frame: features and whether what they tell of is right."""

    boxes: tuple[tuple[dict[str, float], bool], ...]
    parts: tuple[tuple[dict[str, float], bool], ...]


def learn_judgement(
    entries: Sequence[SetEntry],
    lying: Sequence[SetEntry] = (),
    *,
    command: str,
    jobs: int,
    progress: Callable[[str], None] = lambda line: None,
    refuse: Callable[[SetEntry, ValueError | OSError], None] = lambda entry, error: None,
) -> LearnedJudgement:
    """Weights from labelled frames, with boxes and without; the same frames give the same weights.

    From `lying`, frames of boxes on their side, only how such boxes are judged is learnt. A frame that cannot be used
    is left out, and `refuse` told of it.

    Raises ValueError where the frames that can be used hold no right box or no false one, and without scikit-learn.
    """
    require_learner()
    unjudged = list(_seen([*entries, *lying], None, jobs, lambda line: progress(f"unjudged: {line}")))
    count, every, before = 0, [], []
    for k, (entry, told) in enumerate(zip([*entries, *lying], unjudged, strict=True)):
        if not isinstance(told, Examples):
            refuse(entry, told)
            continue
        count += k < len(entries)
        every.append(entry)
        before.append(told)
    first = _fitted(before[:count], before, told_from=(0.0, 0.0, 0.0))
    told_all = _core.Judgement(msgspec.json.encode(dict(zip(("box", "lying", "part"), first, strict=True))).decode())
    # A judgement chooses among rivals, so that it meets others than those that it learnt from.
    judged: list[Examples] = []
    for told in _seen(every, told_all, jobs, lambda line: progress(f"judged: {line}")):
        if not isinstance(told, Examples):
            raise told
        judged.append(told)
    examples = before + judged
    told_from = (TOLD_FROM, LYING_TOLD_FROM, PART_TOLD_FROM)
    box, of_lying, part = _fitted(before[:count] + judged[:count], examples, told_from)
    boxes = [is_right for frame in examples for _, is_right in frame.boxes]
    parts = [is_right for frame in examples for _, is_right in frame.parts]
    return LearnedJudgement(
        box=msgspec.structs.replace(box, doubts=doubts_of(examples)),
        lying=of_lying,
        part=part,
        training=JudgementReport(
            command=command,
            frames=len(every),
            boxes=len(boxes),
            false_boxes=boxes.count(False),
            parts=len(parts),
            wrong_parts=parts.count(False),
        ),
    )


def doubts_of(examples: Sequence[Examples]) -> tuple[Doubt, ...]:
    """Where more is asked; how small is too small is learnt from the logarithms of the right ones' shorter edges."""
    edges = [features["shorter_edge"] for frame in examples for features, is_right in frame.boxes if is_right]
    inside = round(float(np.log1p(INSIDE_READINGS / UNIT_READINGS)), 3)
    return (
        Doubt(
            feature="shorter_edge", below=round(float(np.quantile(edges, SMALL_SHARE)), 3), told_from=SMALL_TOLD_FROM
        ),
        Doubt(feature="on_inner_faces", below=inside, told_from=DOUBTFUL_TOLD_FROM),
        Doubt(feature="side_absent", above=SIDE_ABSENT, told_from=DOUBTFUL_TOLD_FROM),
    )


def _fitted(
    examples: Sequence[Examples], with_lying: Sequence[Examples], told_from: tuple[float, float, float]
) -> tuple[Odds, Odds, Odds]:
    """Of boxes that stand, of boxes that lie, and of parts; how a box stands tells of those that lie, too."""
    found = {
        "box": [example for frame in examples for example in frame.boxes if example[0]["lies"] < 0.5],
        "box on its side": [example for frame in with_lying for example in frame.boxes],
        "part": [example for frame in examples for example in frame.parts],
    }
    for name, told in found.items():
        if len({is_right for _, is_right in told}) < 2:
            raise ValueError(f"the frames show no right and wrong {name} to tell apart; add frames, empty ones too")
    box, lying, part = (fit_odds(told, of) for told, of in zip(found.values(), told_from, strict=True))
    return box, lying, part


def fit_odds(examples: Sequence[tuple[dict[str, float], bool]], told_from: float) -> Odds:
    """A logistic regression, and the trees that mend it."""
    weights = fit_logistic(examples)
    return Odds(weights=weights, trees=fit_trees(examples, weights), told_from=told_from)


def _seen(
    entries: Sequence[SetEntry], judgement: _core.Judgement | None, jobs: int, progress: Callable[[str], None]
) -> Iterator[Examples | ValueError | OSError]:
    # Of the templates only the names of the parts are used: this one has all that a box may have.
    _, model = load_object_model("cake_box", None, "exact")
    for done, told in enumerate(ordered_map(lambda entry: _told_of(entry, model, judgement), entries, jobs), 1):
        if done % 50 == 0:
            progress(f"{done} of {len(entries)} frames")
        yield told


def _told_of(
    entry: SetEntry, model: _core.ObjectModel, judgement: _core.Judgement | None
) -> Examples | ValueError | OSError:
    try:
        return examples_of(entry, model, judgement)
    except (ValueError, OSError) as error:
        return error


def examples_of(entry: SetEntry, model: _core.ObjectModel, judgement: _core.Judgement | None = None) -> Examples:
    """What is found in one frame, and whether it is right: unjudged, or as a judgement chooses that tells all."""
    frame = read_entry(entry)
    cloud = read_cloud(entry.cloud_path)
    _, answer = _core.infer(
        cloud.points,
        cloud.width,
        cloud.height,
        [model],
        viewpoint=cloud.viewpoint,
        fitted=True,
        judgement=judgement,
    )
    objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
    features = tuple(_FEATURES.decode(text) for text in answer.features_json())
    labels = PointLabels(object=answer.object_labels, part=answer.part_labels)
    boxes = score_answer(frame, Answer(objects=objects, labels=labels)).boxes
    of_object = {box.object: box for box in boxes if box.object is not None}
    asked: list[tuple[dict[str, float], bool]] = []
    parts: list[tuple[dict[str, float], bool]] = []
    for k, told in enumerate(features):
        box = of_object.get(k)
        if box is None:
            if not _is_small_box(frame, answer.object_labels == k):
                asked.append((told.box, False))
            continue
        is_right = box.panels_right - box.panels_wrong >= RIGHT_SHARE * box.panels_in_cloud
        asked.append((told.box, is_right))
        if is_right:
            parts += _parts(told, box)
    return Examples(tuple(asked), tuple(parts))


def _parts(told: Features, box: BoxScore) -> Iterator[tuple[dict[str, float], bool]]:
    verdicts = {verdict.name: verdict.verdict for verdict in box.verdicts}
    for name, features in told.parts.items():
        if verdicts.get(name, "neither") != "neither":
            yield features, verdicts[name] == "right"


def _is_small_box(frame: LabelledFrame, mask: NDArray[np.bool_]) -> bool:
    """Whether it lies mostly on a true box, which has too few readings to be asked for, or another object."""
    on_panels = np.asarray(frame.labels).ravel()[mask] > 0
    return bool(on_panels.size) and float(on_panels.mean()) > 0.5


def fit_logistic(examples: Sequence[tuple[dict[str, float], bool]]) -> dict[str, float]:
    """Weights of a logistic regression by Newton's method; the feature `one` is the constant and is not held down."""
    names = list(examples[0][0])
    x = np.array([[features[name] for name in names] for features, _ in examples])
    y = np.array([is_right for _, is_right in examples], float)
    scale = np.where(x.std(axis=0) > 1e-9, x.std(axis=0), 1.0)
    constant = np.array([name == "one" for name in names])
    scale[constant] = 1.0
    scaled = x / scale
    held = np.where(constant, 1e-6, RIDGE)
    weights = np.zeros(len(names))
    for _ in range(STEPS):
        p = 1.0 / (1.0 + np.exp(-(scaled @ weights)))
        gradient = scaled.T @ (p - y) + held * weights
        curvature = (scaled.T * (p * (1.0 - p))) @ scaled + np.diag(held)
        weights -= np.linalg.solve(curvature, gradient)
    return dict(zip(names, (weights / scale).tolist(), strict=True))
