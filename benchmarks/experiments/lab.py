"""What experiments share: frames that are seen once, weights that are learned once, and scores."""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable
from collections.abc import Sequence as Items
from typing import TypeVar

import msgspec
from benchmarks.experiments.frames import TEST_SEED, TRAINING_SEED, Look, Sequence

from boxwright import _core
from boxwright.evaluation import FrameScore, score_frame
from boxwright.learning import SeenFrame, train
from boxwright.models import LearnedWeights
from boxwright.parallel import ordered_map
from boxwright.types import Object

Made = TypeVar("Made")

EXACT: dict[str, float | str] = {"search": "exact", "sum_tolerance": 1.0}
"""The exact search, without the probabilities, which no experiment here asks for."""

# Made once, at import: threads that make their first decoder of a type together have crashed.
_OBJECT = msgspec.json.Decoder(Object)


class Lab:
    """Keeps what was made. `quick` asks for tiny sizes and tidy frames; `jobs` threads change no figure but times.

    `training` and `tests` are the frames that most experiments learn from and are tested on.
    """

    def __init__(self, *, quick: bool, jobs: int) -> None:
        self.quick = quick
        self.jobs = jobs
        tidy = {"boxes": 1, "clutter": False} if quick else {}
        self.training = Sequence(TRAINING_SEED, **tidy)
        self.tests = Sequence(TEST_SEED, **tidy)
        self._frames: dict[tuple[Sequence, int], Look] = {}
        self._made: dict[Hashable, object] = {}

    def size(self, full: Made, quick: Made) -> Made:
        """The one that is asked for."""
        return quick if self.quick else full

    def looks(self, sequence: Sequence, count: int) -> list[Look]:
        """The first `count` frames of a sequence."""
        missing = [k for k in range(count) if (sequence, k) not in self._frames]
        for index, look in zip(missing, ordered_map(sequence.look, missing, self.jobs), strict=True):
            self._frames[sequence, index] = look
        return [self._frames[sequence, k] for k in range(count)]

    def frames(self, sequence: Sequence, count: int) -> list[SeenFrame]:
        """The same, as the paper's front end sees them."""
        return [look.ransac for look in self.looks(sequence, count)]

    def passing_frames(self, sequence: Sequence, count: int) -> list[SeenFrame]:
        """Frames that no other experiment asks for: not kept, since each holds megabytes."""
        return list(ordered_map(lambda index: sequence.look(index).ransac, range(count), self.jobs))

    def learned(self, key: Hashable, template: _core.Template, frames: Items[SeenFrame]) -> LearnedWeights:
        """Weights by the paper's learning; those of an equal `key` are learned once."""
        if key not in self._made:
            self._made[key] = train(template, frames, command="benchmarks.experiments", jobs=self.jobs)
        made = self._made[key]
        assert isinstance(made, LearnedWeights)
        return made

    def scores(
        self,
        models: Items[_core.ObjectModel],
        frames: Items[SeenFrame],
        search: dict[str, float | str] | None = None,
    ) -> list[FrameScore]:
        """The score of each frame; the models compete for its segments."""

        def score(frame: SeenFrame) -> FrameScore:
            answer = _core.understand(frame.perception, list(models), search)
            objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
            return score_frame(objects, answer.object_labels, answer.part_labels, frame.truth, frame.truth_labels)

        return list(ordered_map(score, frames, self.jobs))

    def each(self, function: Callable[[Hashable], Made], items: Items[Hashable]) -> list[Made]:
        """`map` on the lab's threads, in order."""
        return list(ordered_map(function, items, self.jobs))


def model_of(
    template: _core.Template, learned: LearnedWeights, search: dict[str, float | str] | None = None
) -> _core.ObjectModel:
    """A template with weights, ready to be searched with."""
    return _core.ObjectModel(template, msgspec.json.encode(learned).decode(), **(search or {}))


def fastest_ms(run: Callable[[], object], repeats: int) -> float:
    """Milliseconds of CPU time of the fastest of some runs."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        run()
        times.append(time.process_time() - start)
    return 1000.0 * min(times)
