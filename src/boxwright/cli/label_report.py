"""What `boxwright label` prints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from boxwright.cli.outcome_report import print_files, print_problems, print_summaries
from boxwright.cli.screen import console

if TYPE_CHECKING:
    from boxwright.cli.label_steps import Step
    from boxwright.cli.outcome import Outcome


def print_outcome(outcome: Outcome[Step], as_json: bool) -> None:
    """One cloud: its error and warnings on standard error, what to do next on standard output unless JSON is wanted."""
    step = outcome.answer
    print_problems(outcome, () if step is None else step.warnings)
    if step is None or as_json:
        return
    out = console()
    if step.truth is None:
        out.print(f"[bold]{outcome.cloud.stem}[/]: {step.segments} segments wait for roles", soft_wrap=True)
        out.print(f"  fill in {step.form}", soft_wrap=True)
        out.print("  then give the same command again (--no-box where nothing there is such an object)\n")
        return
    boxes, panels = len(step.truth.boxes), len(step.truth.parts)
    counts = f"{boxes} box{'' if boxes == 1 else 'es'}, {panels} panels, {step.without_role} segments without a role"
    out.print(f"[bold]{outcome.cloud.stem}[/]: labelled, {counts}", soft_wrap=True)
    print_files(outcome.files)


def print_json(outcomes: list[Outcome[Step]]) -> None:
    """All clouds as one JSON list: what became of each, or the error."""
    print_summaries(outcomes, _as_json)


def _as_json(step: Step) -> dict[str, Any]:
    return {
        "warnings": list(step.warnings),
        "status": step.status,
        "form": str(step.form),
        "segments": step.segments,
        "boxes": 0 if step.truth is None else len(step.truth.boxes),
        "panels": 0 if step.truth is None else len(step.truth.parts),
    }
