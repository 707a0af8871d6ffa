"""Fitted boxes of labelled frames with their true templates: what kinds are learnt from and judged by."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation import SetEntry, read_entry, score_frame
from boxwright.io.clouds import read_cloud
from boxwright.learning.kinds import KindExamples
from boxwright.models import FITTED_TEMPLATES
from boxwright.parallel import ordered_map, processors
from boxwright.pipeline import infer
from boxwright.types import Truth

NO_KINDS = _core.Kinds('{"format": "boxwright.kinds", "version": 1, "weights": {}}')
"""Tells no templates apart."""
LEAST_READINGS = 400
"""A panel counts as in the cloud with so many (docs/formats.md)."""
TEMPLATE_OF_CATEGORY = {"cake": "cake_box", "pizza": "pizza_box", "tote": "tote"}
"""The others are cartons, unless a tuck flap or no flap at all says otherwise."""


@dataclass(frozen=True, eq=False)
class KindFrame:
    """The true boxes of a frame that were found: true templates, those told, their probabilities, shapes (B, F)."""

    name: str
    missed: int
    true: tuple[str, ...]
    told: tuple[str, ...]
    probability: tuple[float | None, ...]
    shapes: NDArray[np.float64]


def true_template(truth: Truth, box: int) -> str:
    """The template that describes a true box: by its category, and by what of it is in the cloud.

    A box of a carton's category with a tuck flap in the cloud is a cake_box: a carton has no place for it. One without
    any flap is a tote.
    """
    (category,) = (one.category for one in truth.boxes if one.index == box)
    parts = [part for part in truth.parts if part.box == box]
    if not any(part.name.startswith("flap") for part in parts):
        return "tote"
    if category in TEMPLATE_OF_CATEGORY:
        return TEMPLATE_OF_CATEGORY[category]
    has_tuck = any(part.name.startswith("tuck") and part.visible_px >= LEAST_READINGS for part in parts)
    return "cake_box" if has_tuck else "carton"


def kind_frames(
    entries: Sequence[SetEntry], kinds: _core.Kinds | None = None, jobs: int | None = None
) -> list[KindFrame]:
    """Each frame of sets by the method fitted, in order; `kinds` None are the shipped ones.

    Raises ValueError where a frame cannot be used, OSError where a file cannot be read.
    """

    def look(entry: SetEntry) -> KindFrame:
        frame = read_entry(entry)
        inferred = infer(read_cloud(entry.cloud_path), method="fitted", templates=FITTED_TEMPLATES, kinds=kinds)
        objects = inferred.model.objects
        score = score_frame(objects, inferred.object_labels, inferred.part_labels, frame.truth, frame.labels)
        found = [(box.box, box.object) for box in score.boxes if box.object is not None]
        numbers = [number for _, number in found]
        return KindFrame(
            name=entry.name,
            missed=len(score.boxes) - len(found),
            true=tuple(true_template(frame.truth, box) for box, _ in found),
            told=tuple(objects[number].template for number in numbers),
            probability=tuple(objects[number].template_probability for number in numbers),
            shapes=inferred.shapes[numbers],
        )

    return list(ordered_map(look, entries, processors() if jobs is None else jobs))


def examples_of(frames: Sequence[KindFrame]) -> KindExamples:
    """What `learn_kinds` learns from."""
    return KindExamples(
        feature_names=tuple(_core.SHAPE_FEATURES),
        features=np.concatenate([frame.shapes for frame in frames]),
        templates=tuple(name for frame in frames for name in frame.true),
        frames=np.repeat(np.arange(len(frames)), [len(frame.true) for frame in frames]),
    )
