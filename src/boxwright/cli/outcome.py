"""What became of the inputs of a command that answers each with a folder of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Generic, TypeVar

import typer

if TYPE_CHECKING:
    from boxwright.cli.failures import Refusal

Record = TypeVar("Record")


@dataclass(frozen=True)
class Outcome(Generic[Record]):
    """One input's answer and its files, or why there is none."""

    cloud: Path
    answer: Record | None = None
    files: tuple[Path, ...] = ()
    refusal: Refusal | None = None


def answer_each(
    clouds: list[Path],
    answer: Callable[[Path], tuple[Record, tuple[Path, ...]]],
    tell: Callable[[Outcome[Record]], None],
    jobs: int,
    what: str,
) -> list[Outcome[Record]]:
    """Answers all inputs, `jobs` at once, and tells of each as it comes; one that is refused keeps none waiting.

    `answer` gives an input's answer and its files, or raises ValueError or OSError.
    """
    from boxwright.cli.screen import progress
    from boxwright.parallel import ordered_map

    def outcome_of(path: Path) -> Outcome[Record]:
        try:
            return Outcome(path, *answer(path))
        except (ValueError, OSError) as error:
            return Outcome(path, refusal=error)

    outcomes = []
    for outcome in progress(ordered_map(outcome_of, clouds, jobs), len(clouds), what):
        outcomes.append(outcome)
        tell(outcome)
    return outcomes


def refuse_shared_names(clouds: list[Path]) -> None:
    """Two inputs of one NAME would write to one folder."""
    first: dict[str, Path] = {}
    for path in clouds:
        other = first.setdefault(path.stem, path)
        if other is not path:
            raise typer.BadParameter(
                f"{other} and {path} are both named {path.stem!r} and would share one folder; give each its own -o",
                param_hint="CLOUD...",
            )
