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

    def at_least(self, score: float) -> Understood:
        """With the objects of at least that score; they come best first, so their numbers stay."""
        kept = tuple(o for o in self.objects if o.score >= score)
        labels = np.where(self.object_labels < len(kept), self.object_labels, np.int16(-1))
        return Understood(self.frame, kept, labels, self.part_labels)


def understand_all(
    template: _core.Template,
    learned: LearnedWeights,
    frames: Sequence[SeenFrame],
    search: dict[str, float | str],
    jobs: int,
) -> list[Understood]:
    """All frames under the template with these weights and settings of the search."""
    model = _core.ObjectModel(template, msgspec.json.encode(learned).decode(), **search)

    def one(frame: SeenFrame) -> Understood:
        answer = _core.understand(frame.perception, [model], search)
        objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
        return Understood(frame, objects, answer.object_labels, answer.part_labels)

    return list(ordered_map(one, frames, jobs))
