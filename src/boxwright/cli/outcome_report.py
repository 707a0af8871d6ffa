"""What commands print of their inputs, whatever they answer."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from boxwright.cli.failures import one_line, tell, warn
from boxwright.cli.screen import console

if TYPE_CHECKING:
    from boxwright.cli.outcome import Outcome
    from boxwright.types import Seconds

Record = TypeVar("Record")


def print_problems(outcome: Outcome[Record], warnings: Iterable[str]) -> None:
    """An input's error and its answer's warnings on standard error."""
    if outcome.refusal is not None:
        tell(outcome.refusal, outcome.cloud)
    for warning in warnings:
        warn(f"{outcome.cloud}: warning: {warning}")


def head_of(cloud: Path, count: int, what: str, seconds: Seconds) -> str:
    """How many things were found in an input, and in what time."""
    return f"{cloud.stem}: {count or 'no'} {what}{'' if count == 1 else 's'} ({seconds.total:.2f} s)"


def print_stages(seconds: Seconds) -> None:
    """The time of each stage."""
    stages = ", ".join(f"{stage} {1000 * spent:.0f}" for stage, spent in seconds.stages.items())
    console().print(f"ms: read {1000 * seconds.read:.0f}, {stages}", soft_wrap=True)


def print_files(files: tuple[Path, ...]) -> None:
    """Where an input's answer is."""
    console().print(f"in {files[0].parent}: {', '.join(path.name for path in files)}\n", soft_wrap=True)


def print_summaries(outcomes: list[Outcome[Record]], summary: Callable[[Record], dict[str, Any]]) -> None:
    """All inputs as one JSON list: each with its files and its answer's summary, or the error."""
    print(json.dumps([_as_json(outcome, summary) for outcome in outcomes], indent=1))


def _as_json(outcome: Outcome[Record], summary: Callable[[Record], dict[str, Any]]) -> dict[str, Any]:
    if outcome.answer is None:
        return {"input": str(outcome.cloud), "error": one_line(outcome.refusal) if outcome.refusal else None}
    return {
        "input": str(outcome.cloud),
        "files": [str(path) for path in outcome.files],
        **summary(outcome.answer),
    }
