"""`boxwright calibrate`: what the method's probabilities are worth, fitted to frames that no training saw."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.options import JobsOption


def calibrate(
    folders: Annotated[list[Path], typer.Argument(metavar="SET...", help="Folders of labelled frames.")],
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the weights, NAME.json each.")
    ],
    jobs: JobsOption = None,
) -> None:
    """Fit the probabilities of the method exact to labelled frames on which its weights were not learned.

    `train` fits each template's alone; here all shipped templates compete, as in `infer`. The weights stay as they are.
    Frames that cannot be used are told on standard error and left out.

    [bold]Example[/]

    boxwright calibrate set set_without_boxes -o weights
    """
    from boxwright.cli.train import frames_of
    from boxwright.learning import calibrate as fit
    from boxwright.models import TEMPLATE_NAMES, load_template, load_weights, shipped_for
    from boxwright.parallel import processors
    from boxwright.pipeline import PLANES_OF_METHOD

    planes = PLANES_OF_METHOD["exact"]
    shipped = shipped_for("exact", planes)
    models = [(load_template(name, shipped), load_weights(name, shipped)) for name in TEMPLATE_NAMES]
    frames, refused = frames_of(folders, None, planes, jobs)
    calibrated, parts = fit(models, frames, jobs or processors())
    output.mkdir(parents=True, exist_ok=True)
    for weights in calibrated:
        weights.save(output / f"{weights.template}.json")
    print(f"{len(frames)} frames, {parts} parts judged; weights in {output}")
    if refused:
        raise typer.Exit(1)
