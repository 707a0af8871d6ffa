"""The line from evidence to probabilities fitted to what a whole method answers: all its templates at once."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec

from boxwright import _core
from boxwright.learning.part_calibration import fit_calibration, part_verdicts
from boxwright.learning.seen import SeenFrame
from boxwright.learning.understood import understand_by
from boxwright.models import LearnedWeights


def calibrate(
    models: Sequence[tuple[_core.Template, LearnedWeights]], frames: Sequence[SeenFrame], jobs: int = 1
) -> tuple[list[LearnedWeights], int]:
    """The weights of each template with one line for all, and the number of parts that it was fitted to.

    The frames must be such as none of the weights was learnt on: what weights know they get right too often. Templates
    compete for the segments as they do in `infer`. Raises ValueError where no part was found in any frame.
    """
    search: dict[str, float | str] = {"search": "exact"}
    bare = [msgspec.structs.replace(weights, calibration=None) for _, weights in models]
    rivals = [
        _core.ObjectModel(template, msgspec.json.encode(weights).decode(), **search)
        for (template, _), weights in zip(models, bare, strict=True)
    ]
    understood = understand_by(rivals, frames, search, jobs, with_rays=True)
    verdicts = [verdict for one in understood for verdict in part_verdicts(one)]
    line = fit_calibration(verdicts)
    if line is None:
        raise ValueError("no object was found in any frame; probabilities are fitted to parts that were found")
    return [msgspec.structs.replace(weights, calibration=line) for weights in bare], len(verdicts)
