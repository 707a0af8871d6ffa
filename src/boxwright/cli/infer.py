"""`boxwright infer`: from clouds to articulated models."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.options import (
    DepthDecodeOption,
    DepthUnitOption,
    FrameOption,
    IntrinsicsOption,
    JsonOption,
    MethodOption,
    ModelOptions,
    ReadOptions,
    RoiOption,
    TemplateOption,
    UnitOption,
    UpOption,
    ViewpointOption,
    WeightsOption,
)
from boxwright.cli.outcome import Outcome

if TYPE_CHECKING:
    from boxwright.cli.pictures import Drawer

Clouds = Annotated[
    list[Path], typer.Argument(metavar="CLOUD...", help="Clouds: .pcd, .ply, .npy, or depth images .png.")
]
OutOption = Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the folders of answers.")]
JobsOption = Annotated[int, typer.Option("--jobs", min=1, help="Inputs worked on at once.")]
FigureOption = Annotated[bool, typer.Option("--figure", help="Draw NAME.png beside each model.json.")]
VerboseOption = Annotated[bool, typer.Option("--verbose", help="Print the time of each stage too.")]


def infer(
    clouds: Clouds,
    output: OutOption,
    method: MethodOption = None,
    template: TemplateOption = None,
    weights: WeightsOption = None,
    unit: UnitOption = "m",
    frame: FrameOption = "optical",
    viewpoint: ViewpointOption = None,
    up: UpOption = None,
    roi: RoiOption = None,
    intrinsics: IntrinsicsOption = None,
    depth_unit_m: DepthUnitOption = None,
    depth_decode: DepthDecodeOption = "none",
    figure: FigureOption = False,
    jobs: JobsOption = 1,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> None:
    """Find the open boxes of each cloud: panels, hinges, how far each flap is open.

    Writes DIR/NAME/ for each CLOUD: [bold]model.json[/], [bold]labels.npz[/] (object and part of each point) and
    [bold]NAME_K.urdf[/] for each object K with a pose. No object is an answer too.

    [bold]Examples[/]

    boxwright infer frame.pcd -o out --figure

    boxwright infer *.ply -o out --unit mm --frame opengl

    boxwright infer depth.png -o out --intrinsics camera.json --roi=-1,1,-1,1,0.4,2
    """
    from boxwright.cli.infer_report import print_json, print_outcome
    from boxwright.cli.pictures import frame_figure_drawer
    from boxwright.cli.screen import progress
    from boxwright.parallel import ordered_map

    _refuse_shared_names(clouds)
    reading = ReadOptions(unit, frame, viewpoint, intrinsics, depth_unit_m, depth_decode)
    wanted = ModelOptions(method, template, weights, up, roi)
    draw = frame_figure_drawer() if figure else None
    outcomes = []
    work = ordered_map(lambda path: _answer(path, output, reading, wanted, draw), clouds, jobs)
    for outcome in progress(work, len(clouds), "infer"):
        outcomes.append(outcome)
        print_outcome(outcome, verbose, as_json)
    if as_json:
        print_json(outcomes)
    if any(outcome.refusal for outcome in outcomes):
        raise typer.Exit(1)


def _refuse_shared_names(clouds: list[Path]) -> None:
    """Two inputs of one NAME would write to one folder."""
    first: dict[str, Path] = {}
    for path in clouds:
        other = first.setdefault(path.stem, path)
        if other is not path:
            raise typer.BadParameter(
                f"{other} and {path} are both named {path.stem!r} and would share one folder; give each its own -o",
                param_hint="CLOUD...",
            )


def _answer(path: Path, output: Path, reading: ReadOptions, wanted: ModelOptions, draw: Drawer | None) -> Outcome:
    """Reads, infers and writes one input; `draw` draws its figure."""
    import time

    from boxwright.answers import save_answer

    try:
        start = time.perf_counter()
        cloud = reading.read(path)
        inferred = wanted.infer(cloud, time.perf_counter() - start)
        files = save_answer(inferred, output / path.stem, path.stem)
        if draw is not None:
            files = (*files, output / path.stem / f"{path.stem}.png")
            draw(cloud, inferred, files[-1], wanted.template_names)
    except (ValueError, OSError) as error:
        return Outcome(path, refusal=error)
    return Outcome(path, inferred.model, files)
