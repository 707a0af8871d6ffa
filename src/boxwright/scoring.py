"""The way through, held against the truth of a scene set."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from boxwright.evaluation import (
    Answer,
    FrameScore,
    LabelledFrame,
    SetEntry,
    Summary,
    list_set,
    read_entry,
    score_answer,
    summarize,
)
from boxwright.io.clouds import read_cloud
from boxwright.io.labels import NO_LABEL, PointLabels
from boxwright.parallel import ordered_map, processors
from boxwright.pipeline import DEFAULT_METHOD, infer, load_models


@dataclass(frozen=True)
class FrameOutcome:
    """A frame's score, and why the frame was refused where it was.

    A cloud that is refused counts as answered with no object: else refusing what is hard would look like skill. Where
    the truth itself cannot be read there is no score.
    """

    name: str
    score: FrameScore | None
    refusal: ValueError | OSError | None


def evaluate(
    folder: str | os.PathLike[str],
    *,
    method: str = DEFAULT_METHOD,
    templates: tuple[str | Path, ...] | None = None,
    weights: str | Path | None = None,
    planes: str | None = None,
    jobs: int | None = None,
) -> Summary:
    """The figures of merit of a method on a scene set, by category, `all` last: per cent, degrees, millimetres.

    `folder` holds NAME.pcd, NAME.truth.json, NAME.labels.npz for each frame (docs/formats.md); `method`, `templates`,
    `weights` and `planes` are those of `boxwright.infer`; `jobs` threads, by default one for each processor, change
    no bit.

    Raises ValueError with one line where a frame cannot be used, OSError where a file cannot be read.
    """
    scores = []
    outcomes = score_entries(
        list_set(folder), method=method, templates=templates, weights=weights, planes=planes, jobs=jobs
    )
    for outcome in outcomes:
        if outcome.refusal is not None:
            raise outcome.refusal
        if outcome.score is not None:
            scores.append(outcome.score)
    return summarize(scores)


def score_entries(
    entries: Sequence[SetEntry],
    *,
    method: str,
    templates: tuple[str | Path, ...] | None,
    weights: str | Path | None,
    planes: str | None = None,
    jobs: int | None,
) -> Iterator[FrameOutcome]:
    """The outcome of each frame of a set, in order, whatever the number of threads. Arguments are `evaluate`'s.

    Raises ValueError or OSError at once where the arguments fit no frame, as `boxwright.pipeline.load_models` does.
    """
    load_models(method, templates, weights, planes)

    def outcome(entry: SetEntry) -> FrameOutcome:
        try:
            frame = read_entry(entry)
        except (ValueError, OSError) as error:
            return FrameOutcome(entry.name, None, error)
        try:
            cloud = read_cloud(entry.cloud_path)
            inferred = infer(cloud, method=method, templates=templates, weights=weights, planes=planes)
            labels = PointLabels(object=inferred.object_labels, part=inferred.part_labels)
            score = score_answer(frame, Answer(objects=inferred.model.objects, labels=labels))
        except (ValueError, OSError) as error:
            return FrameOutcome(entry.name, score_answer(frame, _no_answer(frame)), error)
        return FrameOutcome(entry.name, score, None)

    return ordered_map(outcome, entries, processors() if jobs is None else jobs)


def _no_answer(frame: LabelledFrame) -> Answer:
    nothing = np.full(len(frame.labels), NO_LABEL, np.int16)
    return Answer(objects=(), labels=PointLabels(object=nothing, part=nothing))
