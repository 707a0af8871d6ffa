"""`boxwright figure`: one frame in the paper's five columns."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import ModelOptions, ReadOptions, SceneOptions


@grouped
def figure(
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="A cloud: .pcd, .ply, .npy, or a depth image .png.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FILE.png", help="Picture to write.")],
    model: ModelOptions,
    reading: ReadOptions,
    scene: SceneOptions,
) -> None:
    """Draw a frame in the paper's five columns: colour or depth, segments, rectangles, matched model, graph.

    Sides are dark, flaps and base light with each flap's angle; hidden panels are dashed. Works without an object too.

    [bold]Example[/]

    boxwright figure frame.pcd -o frame.png
    """
    from boxwright.cli.pictures import frame_figure_drawer

    draw = frame_figure_drawer()
    if output.suffix.lower() != ".png":
        raise typer.BadParameter(f"{str(output)!r} must end in .png", param_hint="--output")
    read = reading.read(cloud)
    draw(read, model.infer(read, scene), output, model.template_names)
    print(output)
