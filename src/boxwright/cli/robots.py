"""`boxwright robots`: which robots there are, and one of them as URDF, MJCF or as a file to change."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.options import JsonOption


def robots(
    robot: Annotated[
        str | None, typer.Argument(metavar="[ROBOT]", help="A name, or one's own .toml or .urdf file; all by default.")
    ] = None,
    urdf: Annotated[
        Path | None,
        typer.Option(
            "--urdf", metavar="FILE", help="Write the robot as URDF, complete: --robot FILE.urdf plans as it does."
        ),
    ] = None,
    mjcf: Annotated[
        Path | None, typer.Option("--mjcf", metavar="FILE", help="Write the robot as MJCF, as physics drives it.")
    ] = None,
    toml: Annotated[
        Path | None, typer.Option("--toml", metavar="FILE", help="Write the robot's own file, to be changed and named.")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """List the known robots, or say what one is: axes, reach, limits, payload, sources and guesses.

    What a .urdf does not tell (accelerations, gripper, links that may touch, where the arm waits) is guessed and said.

    [bold]Examples[/]

    boxwright robots

    boxwright robots viper_s850 --urdf viper.urdf

    boxwright robots my_arm.urdf --toml my_arm.toml
    """
    from boxwright.cli.robots_report import print_json, print_list, print_robot
    from boxwright.robots import load_robot, robot_file, robot_names, robot_text, save_robot_urdf

    if robot is None and (urdf or mjcf or toml):
        raise typer.BadParameter("name the robot to write", param_hint="ROBOT")
    loaded = [load_robot(name) for name in (robot_names() if robot is None else [robot])]
    if robot is not None and urdf is not None:
        save_robot_urdf(loaded[0], urdf)
    if robot is not None and mjcf is not None:
        from boxwright.simulation.physics import Arm

        mjcf.write_text(Arm(robot_file(robot)).mjcf_text(), encoding="utf-8")
    if robot is not None and toml is not None:
        toml.write_text(robot_text(robot), encoding="utf-8")
    if as_json:
        print_json(loaded)
    elif robot is None:
        print_list(loaded)
    else:
        print_robot(loaded[0])
