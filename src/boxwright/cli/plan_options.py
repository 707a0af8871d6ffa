"""Options that the commands which plan share, and the steps that follow from them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

if TYPE_CHECKING:
    from boxwright.types import Model, Plan, Pose

PLANNING = "Planning"

RobotOption = Annotated[
    str,
    typer.Option(
        "--robot", metavar="NAME|FILE", help="A shipped robot, or a robot's .toml or .urdf.", rich_help_panel=PLANNING
    ),
]
CameraPoseOption = Annotated[
    Path | None,
    typer.Option(
        "--camera-pose",
        metavar="POSE.json",
        help="base_from_input: where the input's frame stands before the robot, whose z is up: "
        "position (m), orientation (x y z w).",
        rich_help_panel=PLANNING,
    ),
]
PlaceRobotOption = Annotated[
    bool,
    typer.Option("--place-robot", help="Search a place for the robot's base, and write it.", rich_help_panel=PLANNING),
]
ObjectOption = Annotated[
    int, typer.Option("--object", min=0, metavar="K", help="Which object to close.", rich_help_panel=PLANNING)
]
SceneOption = Annotated[
    Path | None,
    typer.Option(
        "--scene",
        metavar="OBSTACLES.urdf",
        help="What else stands around, in the robot's base frame: <collision> boxes, cylinders and spheres.",
        rich_help_panel=PLANNING,
    ),
]
PlannerOption = Annotated[
    Literal["layered", "paper"],
    typer.Option(
        "--planner",
        help="layered: over contacts, tool angles and postures. paper: planes and samples, by area.",
        rich_help_panel=PLANNING,
    ),
]
CreaseOption = Annotated[
    str | None,
    typer.Option(
        "--crease",
        metavar="CLASS",
        help="Class of the box's creases: pre_broken, ordinary (default), stiff.",
        rich_help_panel=PLANNING,
    ),
]


@dataclass(frozen=True)
class PlanOptions:
    """Which robot closes which object from where, amid what, and how."""

    robot: RobotOption
    camera_pose: CameraPoseOption = None
    place_robot: PlaceRobotOption = False
    object_index: ObjectOption = 0
    scene: SceneOption = None
    planner: PlannerOption = "layered"
    crease: CreaseOption = None

    def require_place(self) -> None:
        """Where the robot stands is told, or searched: one of both, else the command line is wrong."""
        if (self.camera_pose is None) != self.place_robot:
            raise typer.BadParameter(
                "give one of --camera-pose POSE.json and --place-robot", param_hint="--camera-pose"
            )

    def refuse_unfit(self) -> None:
        """Refuses what could not be planned with on any box, before any work; raises as each of its readers does."""
        from boxwright.io.plans import load_pose
        from boxwright.robots import load_robot

        self.require_place()
        load_robot(self.robot)
        self.settings()
        self.things()
        if self.camera_pose is not None:
            load_pose(self.camera_pose)

    def base_pose(self, model: Model) -> Pose:
        """base_from_input: as it was told, or as the search for a place finds it."""
        self.require_place()
        if self.camera_pose is not None:
            from boxwright.io.plans import load_pose

            return load_pose(self.camera_pose)
        from boxwright.planning import place_robot

        return place_robot(model, self.robot, object_index=self.object_index, settings=self.settings())

    def settings(self) -> dict[str, Any] | None:
        """Planning settings for the class of creases that was named; None where none was."""
        return crease_settings(self.crease)

    def things(self) -> tuple[dict[str, Any], ...]:
        """What else stands around; raises as `read_scene` does."""
        return read_things(self.scene)

    def make(self, model: Model, pose: Pose) -> Plan:
        """The plan; raises as `plan_closing` does."""
        from boxwright.planning import plan_closing

        return plan_closing(
            model,
            self.robot,
            pose,
            object_index=self.object_index,
            scene=self.things(),
            method=self.planner,
            settings=self.settings(),
        )


def read_things(scene: Path | None) -> tuple[dict[str, Any], ...]:
    """The things of a scene's file, none where there is no file; raises as `read_scene` does."""
    from boxwright.planning import read_scene

    return () if scene is None else read_scene(scene)


def crease_settings(name: str | None, crease_file: Path | None = None) -> dict[str, Any] | None:
    """What the planner is told of a class of creases, nothing where none is named.

    Raises ValueError naming those that are known, OSError for the file.
    """
    from boxwright.planning import assumed
    from boxwright.simulation.physics import crease_class

    if name is None:
        return None
    crease = crease_class(name, crease_file)
    return assumed(
        moment_n_m_per_m=crease.moment_n_m_per_m, board_m=crease.board_mm / 1000.0, return_rad=crease.return_rad
    )
