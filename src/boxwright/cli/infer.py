"""`boxwright infer`: from clouds to articulated models."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import (
    CloudsArgument,
    InputsOption,
    JsonOption,
    KnownOptions,
    ModelOptions,
    OutOption,
    ReadOptions,
    SceneOptions,
    VerboseOption,
)

if TYPE_CHECKING:
    from boxwright.types import Model

FigureOption = Annotated[bool, typer.Option("--figure", help="Draw NAME.png beside each model.json.")]

MjcfOption = Annotated[bool, typer.Option("--mjcf", help="Write NAME_K.mjcf too, for MuJoCo.")]
SdfOption = Annotated[bool, typer.Option("--sdf", help="Write NAME_K.sdf too, for Gazebo.")]


@grouped
def infer(
    clouds: CloudsArgument,
    output: OutOption,
    model: ModelOptions,
    reading: ReadOptions,
    scene: SceneOptions,
    known: KnownOptions,
    figure: FigureOption = False,
    mjcf: MjcfOption = False,
    sdf: SdfOption = False,
    jobs: InputsOption = 1,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> None:
    """Find the open boxes of each cloud: panels, hinges, how far each flap is open.

    Writes DIR/NAME/ for each CLOUD: [bold]model.json[/], [bold]labels.npz[/] (object and part of each point) and
    [bold]NAME_K.urdf[/] for each object K with a pose. No object is an answer too.

    [bold]Examples[/]

    boxwright infer frame.pcd -o out --figure

    boxwright infer *.ply -o out --unit mm --frame opengl

    boxwright infer frame.pcd -o out --method fitted --size 400x300x200

    boxwright infer depth.png -o out --intrinsics camera.json --roi=-1,1,-1,1,0.4,2
    """
    import time

    from boxwright.answers import save_answer
    from boxwright.cli.infer_report import print_json, print_outcome
    from boxwright.cli.outcome import answer_each, refuse_shared_names
    from boxwright.cli.pictures import frame_figure_drawer

    refuse_shared_names(clouds)
    sizes = known.sizes(model.method_name)
    draw = frame_figure_drawer() if figure else None
    formats = ["urdf", *(["mjcf"] if mjcf else []), *(["sdf"] if sdf else [])]

    def answer(path: Path) -> tuple[Model, tuple[Path, ...]]:
        start = time.perf_counter()
        cloud = reading.read(path)
        inferred = model.infer(cloud, scene, time.perf_counter() - start, sizes)
        files = save_answer(inferred, output / path.stem, path.stem, formats)
        if draw is not None:
            files = (*files, output / path.stem / f"{path.stem}.png")
            draw(cloud, inferred, files[-1], model.template_names)
        return inferred.model, files

    outcomes = answer_each(clouds, answer, lambda outcome: print_outcome(outcome, verbose, as_json), jobs, "infer")
    if as_json:
        print_json(outcomes)
    if any(outcome.refusal for outcome in outcomes):
        raise typer.Exit(1)
