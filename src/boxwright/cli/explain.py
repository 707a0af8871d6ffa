"""`boxwright explain`: what a model's score is made of."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.options import JsonOption

if TYPE_CHECKING:
    from boxwright.types import Model, Object


def explain(
    model: Annotated[Path, typer.Argument(metavar="MODEL", help="A model.json, or a folder that holds one.")],
    as_json: JsonOption = False,
) -> None:
    """Say why each object of a model.json scores as it does: every feature's value, weight and share of the score.

    A share is weight x value; the shares sum to the score J(G). Angles in radians, distances in metres.

    [bold]Example[/]

    boxwright infer frame.pcd -o out && boxwright explain out/frame
    """
    from boxwright.io.models import load_model

    path = model / "model.json" if model.is_dir() else model
    loaded = load_model(path)
    for k, found in enumerate(loaded.objects):
        if not found.score_terms:
            raise ValueError(f"{path}: objects[{k}]: score_terms: is empty; infer the cloud anew to have them")
    if as_json:
        _print_json(loaded)
    else:
        _print_tables(loaded, path)


def _print_json(model: Model) -> None:
    import msgspec

    told = [{"template": o.template, "score": o.score, "score_terms": o.score_terms} for o in model.objects]
    print(msgspec.json.format(msgspec.json.encode(told), indent=1).decode())


def _print_tables(model: Model, path: Path) -> None:
    from boxwright.cli.screen import console

    out = console()
    if not model.objects:
        out.print(f"{path}: no object", soft_wrap=True)
    for k, found in enumerate(model.objects):
        _print_object(k, found)


def _print_object(k: int, found: Object) -> None:
    from boxwright.cli.screen import console, number, table

    made = table(
        f"object {k}: {found.template}, score {found.score:.4f}", "term", "kind", "value", "weight", "weight x value"
    )
    made.columns[1].justify = "left"
    for term in sorted(found.score_terms, key=lambda term: -abs(term.contribution)):
        made.add_row(term.name, term.kind, number(term.value, 4), number(term.weight, 4), number(term.contribution, 4))
    made.add_section()
    made.add_row("sum", "", "", "", number(sum(term.contribution for term in found.score_terms), 4))
    console().print(made)
