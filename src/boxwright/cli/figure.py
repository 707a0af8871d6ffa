"""`boxwright figure`: one frame in the paper's five columns."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.options import (
    DepthDecodeOption,
    DepthUnitOption,
    FrameOption,
    IntrinsicsOption,
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


def figure(
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="A cloud: .pcd, .ply, .npy, or a depth image .png.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="FILE.png", help="Picture to write.")],
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
    wanted = ModelOptions(method, template, weights, up, roi)
    read = ReadOptions(unit, frame, viewpoint, intrinsics, depth_unit_m, depth_decode).read(cloud)
    draw(read, wanted.infer(read), output, wanted.template_names)
    print(output)
