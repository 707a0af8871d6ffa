"""What `boxwright train` prints."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.models import LearnedWeights


def print_json(learned: LearnedWeights) -> None:
    """The weights file's content."""
    import msgspec

    print(msgspec.json.format(msgspec.json.encode(learned), indent=1).decode())


def print_learned(learned: LearnedWeights, path: Path) -> None:
    """How good the fit is, and what counts most."""
    out = console()
    out.print(_terms(learned))
    training = learned.training
    if training is not None:
        out.print(f"{training.frames} frames, {training.candidates} candidates, regularizer {training.regularizer:g}")
        errors = f"fit {training.fit_error:.4f}, held out {training.held_out_error:.4f}"
        out.print(f"error of the predicted correctness (rms): {errors}")
        out.print(f"the best candidate comes first for {100 * training.rank_accuracy:.1f} % of the boxes")
    out.print(f"an object from score {learned.accept_score:g}; weights in {path}", soft_wrap=True)


def _terms(learned: LearnedWeights) -> Table:
    made = table(f"weights of {learned.template}, by importance", "term", "weight", "importance", "share %")
    total = sum(learned.importance.values()) or 1.0
    for name, importance in sorted(learned.importance.items(), key=lambda item: -item[1]):
        made.add_row(name, number(learned.weights[name], 4), number(importance, 4), number(100 * importance / total))
    return made
