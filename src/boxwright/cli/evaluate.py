"""`boxwright evaluate`: a method against the truth of a scene set."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import JobsOption, JsonOption, ModelOptions, PlanesOption


@grouped
def evaluate(
    folder: Annotated[
        Path, typer.Argument(metavar="SET", help="Folder of NAME.pcd, NAME.truth.json, NAME.labels.npz.")
    ],
    model: ModelOptions,
    planes: PlanesOption = None,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE", help="Write all scores as JSON, to compare later.")
    ] = None,
    jobs: JobsOption = None,
    as_json: JsonOption = False,
) -> None:
    """Score a method on a labelled set: accuracy, hinges, angles and dimensions by category, beside the paper's.

    A frame whose cloud is refused counts as answered with nothing, and is told on standard error.

    [bold]Examples[/]

    boxwright synth set --count 60 --seed 7 && boxwright evaluate set

    boxwright evaluate set --template carton --weights mine.json -o scores.json
    """
    import msgspec

    from boxwright.cli.evaluate_report import print_summary
    from boxwright.cli.failures import tell
    from boxwright.cli.screen import progress
    from boxwright.evaluation import list_set, make_evaluation, save_evaluation
    from boxwright.scoring import score_entries

    entries = list_set(folder)
    outcomes = score_entries(
        entries,
        method=model.method_name,
        templates=model.template_names,
        weights=model.weights,
        planes=planes,
        jobs=jobs,
    )
    scores, refused = [], 0
    for outcome in progress(outcomes, len(entries), "evaluate"):
        if outcome.refusal is not None:
            refused += 1
            tell(outcome.refusal, folder / outcome.name)
        if outcome.score is not None:
            scores.append(outcome.score)
    evaluation = make_evaluation(model.method_name, folder.resolve().name, scores)
    if output is not None:
        save_evaluation(evaluation, output)
    if as_json:
        print(msgspec.json.format(msgspec.json.encode(evaluation.summary), indent=1).decode())
    else:
        print_summary(evaluation.summary, evaluation.method, evaluation.set, len(entries), refused)
    if refused:
        raise typer.Exit(1)
