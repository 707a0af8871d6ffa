"""Options that the commands which plan share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

import typer

PLANNING = "Planning"

RobotOption = Annotated[
    str,
    typer.Option(
        "--robot", metavar="NAME|FILE.toml", help="A shipped robot, or a robot's file.", rich_help_panel=PLANNING
    ),
]
CameraPoseOption = Annotated[
    Path | None,
    typer.Option(
        "--camera-pose",
        metavar="POSE.json",
        help="base_from_input: where the input's frame stands before the robot: position (m), orientation (x y z w).",
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
        help="What else stands around, in the robot's base frame: boxes, cylinders and spheres.",
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
