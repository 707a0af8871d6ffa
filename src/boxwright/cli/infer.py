"""`boxwright infer`: from clouds to articulated models."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.known_options import KnownOptions
from boxwright.cli.options import (
    CloudsOrPosesArgument,
    InputsOption,
    JsonOption,
    ModelOptions,
    OutOption,
    PosesOption,
    ReadOptions,
    SceneOptions,
    VerboseOption,
)

if TYPE_CHECKING:
    from boxwright.cli.infer_report import Told

FigureOption = Annotated[bool, typer.Option("--figure", help="Draw NAME.png beside each model.json.")]

MjcfOption = Annotated[bool, typer.Option("--mjcf", help="Write NAME_K.mjcf too, for MuJoCo.")]
SdfOption = Annotated[bool, typer.Option("--sdf", help="Write NAME_K.sdf too, for Gazebo.")]


@grouped
def infer(
    output: OutOption,
    model: ModelOptions,
    reading: ReadOptions,
    scene: SceneOptions,
    known: KnownOptions,
    clouds: CloudsOrPosesArgument = None,
    poses: PosesOption = None,
    figure: FigureOption = False,
    mjcf: MjcfOption = False,
    sdf: SdfOption = False,
    jobs: InputsOption = 1,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> None:
    """Find the open boxes of each cloud: panels, hinges, how far each flap is open.

    Writes DIR/NAME/ for each CLOUD: [bold]model.json[/], [bold]labels.npz[/] (object and part of each point) and
    [bold]NAME_K.urdf[/] for each object K with a pose. No object is an answer too. --poses takes several frames of one
    scene instead, and writes one model of them and [bold]labels_K.npz[/] for each frame K.

    [bold]Examples[/]

    boxwright infer frame.pcd -o out --figure

    boxwright infer *.ply -o out --unit mm --frame opengl

    boxwright infer frame.pcd -o out --method fitted --size 400x300x200

    boxwright infer --poses looks.toml -o out

    boxwright infer depth.png -o out --intrinsics camera.json --roi=-1,1,-1,1,0.4,2
    """
    from boxwright.cli.answering import Answering
    from boxwright.cli.frames import inputs_of
    from boxwright.cli.infer_report import print_json, print_outcome
    from boxwright.cli.outcome import answer_each
    from boxwright.cli.pictures import frame_figure_drawer

    inputs = inputs_of(clouds, poses, model)
    sizes = known.sizes(model.method_name)
    model.refuse_unfit(scene)
    draw = frame_figure_drawer() if figure else None
    formats = ["urdf", *(["mjcf"] if mjcf else []), *(["sdf"] if sdf else [])]
    answering = Answering(model, reading, scene, sizes, output, formats)

    def answer(path: Path) -> tuple[Told, tuple[Path, ...]]:
        made = answering.of_cloud(path) if poses is None else answering.of_poses(path)
        files = made.files
        if draw is not None:
            files = (*files, made.folder / f"{made.name}.png")
            draw(made.cloud, made.first, files[-1], model.template_names)
        return made.told, files

    outcomes = answer_each(inputs, answer, lambda outcome: print_outcome(outcome, verbose, as_json), jobs, "infer")
    if as_json:
        print_json(outcomes, verbose)
    if any(outcome.refusal for outcome in outcomes):
        raise typer.Exit(1)
