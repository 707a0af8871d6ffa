"""What `boxwright train` prints."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.models import LearnedWeights
    from boxwright.models.weights import LeftOut


ERROR_OF_LEARNER = {
    "ridge": "error of the predicted correctness (rms)",
    "margin": "correctness that the best assignment lacks (mean)",
    "likelihood": "-log of the truth's probability (mean)",
}


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
        out.print(f"{ERROR_OF_LEARNER[training.learner]}: {errors}")
        out.print(f"the best candidate comes first for {100 * training.rank_accuracy:.1f} % of the boxes")
        if training.left_out:
            out.print(_left_out(training.left_out))
    out.print(f"an object from score {learned.accept_score:g}; weights in {path}", soft_wrap=True)


def _left_out(frames: tuple[LeftOut, ...]) -> Table:
    made = table("each frame by weights fitted without it", "frame", "correct %", "reachable %")
    for left in frames:
        made.add_row(left.frame, number(100 * left.correctness), number(100 * left.reachable))
    made.add_section()
    correct = sum(left.correctness for left in frames) / len(frames)
    reachable = sum(left.reachable for left in frames) / len(frames)
    made.add_row("mean", number(100 * correct), number(100 * reachable))
    return made


def _terms(learned: LearnedWeights) -> Table:
    made = table(f"weights of {learned.template}, by importance", "term", "weight", "importance", "share %")
    total = sum(learned.importance.values()) or 1.0
    for name, importance in sorted(learned.importance.items(), key=lambda item: -item[1]):
        made.add_row(name, number(learned.weights[name], 4), number(importance, 4), number(100 * importance / total))
    return made
