"""Options that several commands share, and what they come to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal, NamedTuple

import typer

if TYPE_CHECKING:
    from boxwright.pipeline import Inferred
    from boxwright.types import Cloud


class Triple(NamedTuple):
    """A point or a direction, input's frame."""

    x: float
    y: float
    z: float

    @staticmethod
    def parse(text: str) -> Triple:
        """From "X,Y,Z"."""
        x, y, z = _numbers(text, 3)
        return Triple(x, y, z)


class Bounds(NamedTuple):
    """A region of interest, metres, input's frame."""

    x_low: float
    x_high: float
    y_low: float
    y_high: float
    z_low: float
    z_high: float

    @staticmethod
    def parse(text: str) -> Bounds:
        """From "XLO,XHI,YLO,YHI,ZLO,ZHI"."""
        return Bounds(*_numbers(text, 6))


def _numbers(text: str, count: int) -> list[float]:
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        raise typer.BadParameter(f"{text!r} holds something that is no number; must be {count} numbers") from None
    if len(values) != count:
        raise typer.BadParameter(f"{text!r} has {len(values)} numbers; must be {count} with commas between them")
    return values


def known_method(value: str | None) -> str | None:
    """A method that is built; a wrong command line otherwise."""
    from boxwright.pipeline import METHODS

    if value is not None and value not in METHODS:
        raise typer.BadParameter(f"{value!r} is not known; known are {', '.join(METHODS)}")
    return value


READING = "Reading the cloud"
MODEL = "Finding objects"

UnitOption = Annotated[
    Literal["m", "mm"], typer.Option("--unit", help="Unit of the file's coordinates.", rich_help_panel=READING)
]
FrameOption = Annotated[
    Literal["optical", "opengl"],
    typer.Option(
        "--frame",
        help="Camera frame of an organized cloud: optical looks along +z, opengl along -z.",
        rich_help_panel=READING,
    ),
]
ViewpointOption = Annotated[
    Triple | None,
    typer.Option(
        "--viewpoint",
        parser=Triple.parse,
        metavar="X,Y,Z",
        help="Where the sensor stood, metres, input's frame. An unorganized cloud has none unless it is given.",
        rich_help_panel=READING,
    ),
]
IntrinsicsOption = Annotated[
    Path | None,
    typer.Option(
        "--intrinsics",
        metavar="FILE",
        help="Camera of a depth image (.png): boxwright JSON, ROS camera_info YAML, or cam.info.txt.",
        rich_help_panel=READING,
    ),
]
DepthUnitOption = Annotated[
    float | None,
    typer.Option(
        "--depth-unit-m",
        metavar="METRES",
        help="Metres of one step of a depth image, e.g. 0.001; goes before what the intrinsics say.",
        rich_help_panel=READING,
    ),
]
DepthDecodeOption = Annotated[
    Literal["none", "rotate3"],
    typer.Option(
        "--depth-decode", help="rotate3 for depth bits rotated by three (RealSense F200).", rich_help_panel=READING
    ),
]
MethodOption = Annotated[
    str | None,
    typer.Option(
        "--method", callback=known_method, metavar="NAME", help="paper: as of 2011 (default).", rich_help_panel=MODEL
    ),
]
TemplateOption = Annotated[
    list[str] | None,
    typer.Option(
        "--template",
        metavar="NAME|FILE.toml",
        help="Object template; repeatable, they compete. Default: carton, cake_box, pizza_box.",
        rich_help_panel=MODEL,
    ),
]
WeightsOption = Annotated[
    Path | None,
    typer.Option("--weights", metavar="FILE", help="Learned weights of the one --template.", rich_help_panel=MODEL),
]
UpOption = Annotated[
    Triple | None,
    typer.Option(
        "--up",
        parser=Triple.parse,
        metavar="X,Y,Z",
        help="Direction away from the floor, input's frame; found from the cloud unless given.",
        rich_help_panel=MODEL,
    ),
]
RoiOption = Annotated[
    Bounds | None,
    typer.Option(
        "--roi",
        parser=Bounds.parse,
        metavar="XLO,XHI,YLO,YHI,ZLO,ZHI",
        help="Leave out all points beyond these bounds, metres, input's frame.",
        rich_help_panel=MODEL,
    ),
]
JobsOption = Annotated[int | None, typer.Option("--jobs", min=1, help="Threads; default: one for each processor.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON for programs instead of tables.")]


@dataclass(frozen=True)
class ReadOptions:
    """How a cloud's file is to be read."""

    unit: Literal["m", "mm"]
    frame: Literal["optical", "opengl"]
    viewpoint: Triple | None
    intrinsics: Path | None
    depth_unit_m: float | None
    depth_decode: Literal["none", "rotate3"]

    def read(self, path: Path) -> Cloud:
        """The cloud in that file; raises as `read_cloud` does."""
        from boxwright.io.clouds import read_cloud

        return read_cloud(
            path,
            unit=self.unit,
            frame=self.frame,
            viewpoint=self.viewpoint,
            intrinsics=self.intrinsics,
            depth_unit_m=self.depth_unit_m,
            depth_decode=self.depth_decode,
        )


@dataclass(frozen=True)
class ModelOptions:
    """What is looked for in a cloud."""

    method: str | None
    templates: list[str] | None
    weights: Path | None
    up: Triple | None = None
    roi: Bounds | None = None

    @property
    def method_name(self) -> str:
        """The method that is meant."""
        from boxwright.pipeline import DEFAULT_METHOD

        return self.method or DEFAULT_METHOD

    @property
    def template_names(self) -> tuple[str, ...]:
        """The templates that compete."""
        from boxwright.models import TEMPLATE_NAMES

        return tuple(self.templates) if self.templates else TEMPLATE_NAMES

    def infer(self, cloud: Cloud, read_seconds: float = 0.0) -> Inferred:
        """The objects of a cloud; raises as `boxwright.infer` does."""
        from boxwright.pipeline import infer

        return infer(
            cloud,
            method=self.method_name,
            templates=self.template_names,
            weights=self.weights,
            up=self.up,
            roi=self.roi,
            read_seconds=read_seconds,
        )
