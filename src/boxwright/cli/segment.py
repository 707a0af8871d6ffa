"""`boxwright segment`: from clouds to planar segments."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import (
    CloudsArgument,
    InputsOption,
    JsonOption,
    OutOption,
    ReadOptions,
    SceneOptions,
)

if TYPE_CHECKING:
    from boxwright.types import Segmentation

FigureOption = Annotated[bool, typer.Option("--figure/--no-figure", help="Draw NAME_segments.png too.")]
VerboseOption = Annotated[bool, typer.Option("--verbose", help="Print the time of each stage too.")]


@grouped
def segment(
    clouds: CloudsArgument,
    output: OutOption,
    reading: ReadOptions,
    scene: SceneOptions,
    figure: FigureOption = True,
    jobs: InputsOption = 1,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> None:
    """Find the planar segments of each cloud: planes, rectangles, what ends each side, what belongs together.

    Writes DIR/NAME/ for each CLOUD: [bold]segments.json[/], [bold]labels.npz[/] (segment of each point) and
    [bold]NAME_segments.png[/]. Segments have no meaning yet; boxes are found by infer.

    [bold]Examples[/]

    boxwright segment frame.pcd -o out

    boxwright segment fused.ply -o out --up 0,0,1 --no-figure

    boxwright segment depth.png -o out --intrinsics camera.json --planes grid --json
    """
    import time

    from boxwright.answers import save_segmentation
    from boxwright.cli.outcome import answer_each, refuse_shared_names
    from boxwright.cli.pictures import segments_figure_drawer
    from boxwright.cli.segment_report import print_json, print_outcome

    refuse_shared_names(clouds)
    draw = segments_figure_drawer() if figure else None

    def answer(path: Path) -> tuple[Segmentation, tuple[Path, ...]]:
        start = time.perf_counter()
        cloud = reading.read(path)
        segmented = scene.segment(cloud, time.perf_counter() - start)
        files = save_segmentation(segmented, output / path.stem)
        if draw is not None:
            files = (*files, output / path.stem / f"{path.stem}_segments.png")
            draw(cloud, segmented, files[-1])
        return segmented.segmentation, files

    outcomes = answer_each(clouds, answer, lambda outcome: print_outcome(outcome, verbose, as_json), jobs, "segment")
    if as_json:
        print_json(outcomes)
    if any(outcome.refusal for outcome in outcomes):
        raise typer.Exit(1)
