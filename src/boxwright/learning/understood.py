"""Labelled frames understood with weights that are being made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.learning.seen import SeenFrame
from boxwright.models import LearnedWeights
from boxwright.parallel import ordered_map
from boxwright.perception import chosen
from boxwright.types import Object

# Made once, at import: threads that make their first decoder of a type together have crashed.
_OBJECT = msgspec.json.Decoder(Object)


@dataclass(frozen=True, eq=False)
class Understood:
    """A frame with the objects found in it, best first, and each point's object and part, (N,), -1 for none."""

    frame: SeenFrame
    objects: tuple[Object, ...]
    object_labels: NDArray[np.int16]
    part_labels: NDArray[np.int16]
    evidence: tuple[tuple[list[float] | None, ...], ...] = ()
    """For each object what is known of each part (`_core.EVIDENCE`), None where it was not found or summed."""

    def at_least(self, score: float) -> Understood:
        """With the objects of at least that score; they come best first, so their numbers stay."""
        kept = tuple(o for o in self.objects if o.score >= score)
        labels = np.where(self.object_labels < len(kept), self.object_labels, np.int16(-1))
        return Understood(self.frame, kept, labels, self.part_labels, self.evidence[: len(kept)])


def understand_all(
    template: _core.Template,
    learned: LearnedWeights,
    frames: Sequence[SeenFrame],
    search: dict[str, float | str],
    jobs: int,
    *,
    with_rays: bool = False,
) -> list[Understood]:
    """All frames under the template with these weights and settings of the search.

    `with_rays` asks the rays of those frames whose cloud can be read again.
    """
    model = _core.ObjectModel(template, msgspec.json.encode(learned).decode(), **search)
    return understand_by([model], frames, search, jobs, with_rays=with_rays)


def understand_by(
    models: Sequence[_core.ObjectModel],
    frames: Sequence[SeenFrame],
    search: dict[str, float | str],
    jobs: int,
    *,
    with_rays: bool,
) -> list[Understood]:
    """All frames under models that compete for the segments; see `understand_all`."""
    rivals = list(models)

    def one(frame: SeenFrame) -> Understood:
        answer = _with_rays(frame, rivals, search) if with_rays else None
        answer = answer or _core.understand(frame.perception, rivals, search)
        objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
        evidence = tuple(tuple(answer.evidence(k)) for k in range(len(objects)))
        return Understood(frame, objects, answer.object_labels, answer.part_labels, evidence)

    return list(ordered_map(one, frames, jobs))


def _with_rays(
    frame: SeenFrame, models: list[_core.ObjectModel], search: dict[str, float | str]
) -> _core.Answer | None:
    """The frame's cloud inferred anew; None where it cannot be read again."""
    if frame.read is None:
        return None
    cloud = frame.read()
    _, answer = _core.infer(
        cloud.points,
        cloud.width,
        cloud.height,
        models,
        viewpoint=cloud.viewpoint,
        perception=chosen(frame.planes),
        search=search,
    )
    return answer
