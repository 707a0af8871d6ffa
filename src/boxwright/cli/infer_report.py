"""What `boxwright infer` prints."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from boxwright.cli.outcome_report import head_of, print_files, print_problems, print_stages, print_summaries
from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.cli.outcome import Outcome
    from boxwright.types import Model, Object
    from boxwright.types.truth import Vector


@dataclass(frozen=True)
class Told:
    """A model, and why candidates are no objects of it, one line each."""

    model: Model
    refused: tuple[str, ...] = ()


def print_outcome(outcome: Outcome[Told], verbose: bool, as_json: bool) -> None:
    """One input: its error and warnings on standard error, its objects on standard output unless JSON is wanted."""
    model = None if outcome.answer is None else outcome.answer.model
    print_problems(outcome, () if model is None else model.warnings)
    if model is None or as_json:
        return
    out = console()
    head = head_of(outcome.cloud, len(model.objects), "object", model.seconds)
    out.print(object_table(head, model.objects) if model.objects else f"[bold]{head}[/]\n")
    if verbose and outcome.answer is not None:
        for line in outcome.answer.refused:
            out.print(line, markup=False, soft_wrap=True)
        for k, found in enumerate(model.objects):
            print_knowledge(k, found, model.up)
        print_stages(model.seconds)
    print_files(outcome.files)


def print_json(outcomes: list[Outcome[Told]], verbose: bool) -> None:
    """All inputs as one JSON list: what was found in which files, or the error; what was refused too if `verbose`."""
    print_summaries(outcomes, lambda told: _as_json(told) | ({"refused": list(told.refused)} if verbose else {}))


def _as_json(told: Told) -> dict[str, Any]:
    model = told.model
    return {
        "warnings": list(model.warnings),
        "seconds": model.seconds.total,
        "objects": [{"template": found.template, "score": found.score} for found in model.objects],
    }


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


def print_knowledge(number: int, found: Object, up: Vector) -> None:
    """The given size that an object has, how its walls lean, and for each hidden part from where it would be seen."""
    out = console()
    if found.size is not None:
        outer = " x ".join(f"{1000 * metres:.0f}" for metres in found.size.outer_dimensions)
        told = f"{found.size.name} (length x width x height {outer} mm outside)"
        out.print(f"{number} {found.template} has the size {told}", soft_wrap=True)
    leans = [(part.name, found.parameters.get(f"{part.name}_lean")) for part in found.parts]
    walls = ", ".join(f"{name} {math.degrees(lean.value):.1f}" for name, lean in leans if lean is not None)
    if walls:
        out.print(f"{number} {found.template} walls lean outwards, deg: {walls}", soft_wrap=True)
    for part in found.parts:
        if part.seen_from is None or part.state is None:
            continue
        height = math.degrees(
            math.asin(max(-1.0, min(1.0, sum(a * b for a, b in zip(part.seen_from, up, strict=True)))))
        )
        way = ", ".join(f"{coordinate:.2f}" for coordinate in part.seen_from)
        how = f"hidden ({part.state.hidden:.2f}); seen from ({way}), {height:.0f} deg above the horizon"
        out.print(f"{number} {found.template} {part.name}: {how}", soft_wrap=True)


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
