"""Options that several commands share, and what they come to."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from boxwright.cli.values import Bounds, Triple

if TYPE_CHECKING:
    from boxwright.fusion import Fused
    from boxwright.pipeline import Inferred
    from boxwright.segmentation import Segmented
    from boxwright.types import Cloud, KnownSize, PosedCloud


def _known_method(value: str | None) -> str | None:
    """A method that is built; a wrong command line otherwise."""
    from boxwright.pipeline import METHODS

    if value is not None and value not in METHODS:
        raise typer.BadParameter(f"{value!r} is not known; known are {', '.join(METHODS)}")
    return value


def _known_planes(value: str | None) -> str | None:
    """A front end that the core has; a wrong command line otherwise."""
    from boxwright._core import PLANES

    if value is not None and value not in PLANES:
        raise typer.BadParameter(f"{value!r} is not known; known are {', '.join(PLANES)}")
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
        "--method",
        callback=_known_method,
        metavar="NAME",
        help="fitted (default): boxes held against the depth image and fitted to it as one body. "
        "exact: planes of the image grid, exact search, probabilities. paper: as of 2011.",
        rich_help_panel=MODEL,
    ),
]
TemplateOption = Annotated[
    list[str] | None,
    typer.Option(
        "--template",
        metavar="NAME|FILE.toml",
        help="Object template; repeatable, they compete. Default: carton, cake_box, pizza_box; fitted: tote too. "
        "closed_carton, fitted: closed boxes.",
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
        parser=Triple.parse_direction,
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
PlanesOption = Annotated[
    str | None,
    typer.Option(
        "--planes",
        callback=_known_planes,
        metavar="NAME",
        help="How planes are found. grid: grown on the image grid, or on voxels; ransac: as of 2011. "
        "Default: that of the method (fitted, exact: grid; paper: ransac); segment, label: grid.",
        rich_help_panel=MODEL,
    ),
]
JobsOption = Annotated[int | None, typer.Option("--jobs", min=1, help="Threads; default: one for each processor.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print JSON for programs instead of tables.")]
VerboseOption = Annotated[
    bool,
    typer.Option(
        "--verbose",
        help="Tell too why candidates were refused, which given size a box has, from where hidden parts would be seen, "
        "and the time of each stage; with --json the refusals alone.",
    ),
]
CLOUDS_HELP = "Clouds: .pcd, .ply, .npy, or depth images .png."
CloudsArgument = Annotated[list[Path], typer.Argument(metavar="CLOUD...", help=CLOUDS_HELP)]
CloudsOrPosesArgument = Annotated[list[Path] | None, typer.Argument(metavar="CLOUD...", help=CLOUDS_HELP)]
PosesOption = Annotated[
    Path | None,
    typer.Option(
        "--poses",
        metavar="FILE.toml",
        help="Frames of one static scene and where their cameras stood (docs/formats.md), fused into one model. "
        "--method fitted.",
        rich_help_panel=READING,
    ),
]
OutOption = Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for the folders of answers.")]
InputsOption = Annotated[int, typer.Option("--jobs", min=1, help="Inputs worked on at once.")]


@dataclass(frozen=True)
class ReadOptions:
    """How a cloud's file is to be read."""

    unit: UnitOption = "m"
    frame: FrameOption = "optical"
    viewpoint: ViewpointOption = None
    intrinsics: IntrinsicsOption = None
    depth_unit_m: DepthUnitOption = None
    depth_decode: DepthDecodeOption = "none"

    def read(self, path: Path) -> Cloud:
        """The cloud in that file; raises as `read_cloud` does."""
        from boxwright.io.clouds import read_cloud

        return read_cloud(path, **asdict(self))


@dataclass(frozen=True)
class SceneOptions:
    """What is known of the scene, and how its planes are found."""

    up: UpOption = None
    roi: RoiOption = None
    planes: PlanesOption = None

    def segment(self, cloud: Cloud, read_seconds: float = 0.0) -> Segmented:
        """The segments of a cloud; raises as `segment` does."""
        from boxwright.segmentation import segment

        return segment(cloud, up=self.up, roi=self.roi, planes=self.planes, read_seconds=read_seconds)


@dataclass(frozen=True)
class ModelOptions:
    """What is looked for in a cloud."""

    method: MethodOption = None
    template: TemplateOption = None
    weights: WeightsOption = None

    @property
    def method_name(self) -> str:
        """The method that is meant."""
        from boxwright.pipeline import DEFAULT_METHOD

        return self.method or DEFAULT_METHOD

    @property
    def template_names(self) -> tuple[str, ...]:
        """The templates that compete."""
        from boxwright.pipeline import TEMPLATES_OF_METHOD

        return tuple(self.template) if self.template else TEMPLATES_OF_METHOD[self.method_name]

    def refuse_unfit(self, scene: SceneOptions) -> None:
        """Refuses what fits no cloud before any is read; raises as `boxwright.pipeline.load_models` does."""
        from boxwright.pipeline import load_models

        load_models(self.method_name, self.template_names, self.weights, scene.planes)

    def infer_frames(
        self,
        frames: Sequence[PosedCloud],
        scene: SceneOptions,
        read_seconds: float = 0.0,
        sizes: tuple[KnownSize, ...] = (),
        source: str = "",
    ) -> Fused:
        """The objects of several frames of one scene; raises as `boxwright.infer_frames` does."""
        from boxwright.fusion import infer_frames

        return infer_frames(
            frames,
            templates=self.template_names,
            up=scene.up,
            roi=scene.roi,
            planes=scene.planes,
            sizes=sizes,
            read_seconds=read_seconds,
            source=source,
        )

    def refuse_for_frames(self) -> None:
        """Raises typer.BadParameter where what was asked for cannot be had of several frames."""
        if self.method_name != "fitted":
            raise typer.BadParameter(
                f"method {self.method_name!r} does not fuse frames; add --method fitted", param_hint="--poses"
            )
        if self.weights is not None:
            raise typer.BadParameter("frames are fused by weights of their own; leave it out", param_hint="--weights")

    def infer(
        self, cloud: Cloud, scene: SceneOptions, read_seconds: float = 0.0, sizes: tuple[KnownSize, ...] = ()
    ) -> Inferred:
        """The objects of a cloud; raises as `boxwright.infer` does."""
        from boxwright.pipeline import infer

        return infer(
            cloud,
            method=self.method_name,
            templates=self.template_names,
            weights=self.weights,
            up=scene.up,
            roi=scene.roi,
            planes=scene.planes,
            sizes=sizes,
            read_seconds=read_seconds,
        )
