"""What `boxwright infer` prints."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from boxwright.cli.failures import one_line, tell, warn
from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.cli.outcome import Outcome
    from boxwright.types import Model, Object


def print_outcome(outcome: Outcome, verbose: bool, as_json: bool) -> None:
    """One input: its error and warnings on standard error, its objects on standard output unless JSON is wanted."""
    if outcome.refusal is not None:
        tell(outcome.refusal, outcome.cloud)
    if outcome.model is None:
        return
    for warning in outcome.model.warnings:
        warn(f"{outcome.cloud}: warning: {warning}")
    if not as_json:
        _print_model(outcome.cloud.stem, outcome.model, verbose)
        console().print(
            f"in {outcome.files[0].parent}: {', '.join(path.name for path in outcome.files)}\n", soft_wrap=True
        )


def print_json(outcomes: list[Outcome]) -> None:
    """All inputs as one JSON list: what was found in which files, or the error."""
    print(json.dumps([_as_json(outcome) for outcome in outcomes], indent=1))


def _as_json(outcome: Outcome) -> dict[str, Any]:
    if outcome.model is None:
        return {"input": str(outcome.cloud), "error": one_line(outcome.refusal) if outcome.refusal else None}
    return {
        "input": str(outcome.cloud),
        "files": [str(path) for path in outcome.files],
        "warnings": list(outcome.model.warnings),
        "seconds": outcome.model.seconds.total,
        "objects": [{"template": found.template, "score": found.score} for found in outcome.model.objects],
    }


def _print_model(name: str, model: Model, verbose: bool) -> None:
    out = console()
    count = len(model.objects)
    title = f"{name}: {count or 'no'} object{'' if count == 1 else 's'} ({model.seconds.total:.2f} s)"
    if count:
        out.print(object_table(title, model.objects))
    else:
        out.print(f"[bold]{title}[/]\n")
    if verbose:
        stages = ", ".join(f"{stage} {1000 * seconds:.0f}" for stage, seconds in model.seconds.stages.items())
        out.print(f"ms: read {1000 * model.seconds.read:.0f}, {stages}")


def object_table(title: str, objects: tuple[Object, ...]) -> Table:
    """A line for each hinge of each object."""
    made = table(title, "object", "score", "length x width x height", "hinge", "angle", "seen", "readings")
    made.columns[3].justify = "left"
    for k, found in enumerate(objects):
        head = (f"{k} {found.template}", number(found.score, 2), _size(found))
        rows = _hinge_rows(found) or [("-", "-", "-", "-")]
        for i, row in enumerate(rows):
            made.add_row(*(head if i == 0 else ("", "", "")), *row, end_section=i == len(rows) - 1)
    return made


def _size(found: Object) -> str:
    if found.dimensions is None:
        return "unknown"
    return " x ".join(f"{1000 * metres:.0f}" for metres in found.dimensions) + " mm"


def _hinge_rows(found: Object) -> list[tuple[str, str, str, str]]:
    rows = []
    for joint in found.joints:
        flap = found.part(joint.child)
        angle = f"{math.degrees(joint.position):.1f} deg"
        rows.append((joint.name, angle, "yes" if flap.observed else "no", str(flap.points)))
    return rows
