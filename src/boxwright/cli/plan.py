"""`boxwright plan`: from a model to the motions that close its box."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import JsonOption
from boxwright.cli.plan_options import PlanOptions


@grouped
def plan(
    model_dir: Annotated[
        Path, typer.Argument(metavar="DIR/NAME", help="What `boxwright infer` wrote: a folder with model.json.")
    ],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="PLAN_DIR", help="Folder to write to.")],
    planning: PlanOptions,
    moves: Annotated[
        bool, typer.Option("--moves", help="Look for the smallest move of the base that lets an open flap be closed.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """Plan the motions that close a box's flaps, or say why not.

    Writes [bold]plan.json[/], [bold]trajectory.csv[/], [bold]trajectory.mcap[/] (trajectory_msgs/msg/JointTrajectory)
    and the model that was planned on; an earlier plan in that folder, and what was run of it, is removed. A plan that
    closes nothing has no trajectory. Exit status 3 when some open flap is not closed by the plan.

    [bold]Examples[/]

    boxwright plan out/frame --robot viper_s850 --camera-pose camera.json -o out/plan

    boxwright plan out/frame --robot my_arm.toml --place-robot -o out/plan --scene fence.urdf
    """
    from boxwright.cli.plan_report import exit_status, print_plan
    from boxwright.cli.plan_steps import save_plan_folder
    from boxwright.io.models import load_model

    planning.refuse_unfit()
    model = load_model(model_dir / "model.json")
    pose = planning.base_pose(model)
    made = planning.make(model, pose)
    if moves:
        from boxwright.planning import with_moves

        made = with_moves(made, model, planning.robot, planning.settings())
    files = save_plan_folder(made, model, pose, output, keep=model_dir)
    print_plan(made, files, as_json=as_json)
    status = exit_status(made)
    if status:
        raise typer.Exit(status)
