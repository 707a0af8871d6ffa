"""`boxwright close`: from a cloud to a closed box, in physics."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import JsonOption, ModelOptions, ReadOptions, SceneOptions
from boxwright.cli.plan_options import (
    CameraPoseOption,
    ObjectOption,
    PlaceRobotOption,
    PlannerOption,
    RobotOption,
    SceneOption,
)


@grouped
def close(
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="A cloud: .pcd, .ply, .npy, or a depth image .png.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder to write to.")],
    robot: RobotOption,
    model: ModelOptions,
    reading: ReadOptions,
    looking: SceneOptions,
    camera_pose: CameraPoseOption = None,
    place_robot: PlaceRobotOption = False,
    object_index: ObjectOption = 0,
    scene: SceneOption = None,
    planner: PlannerOption = "layered",
    truth: Annotated[
        Path | None,
        typer.Option("--truth", metavar="NAME.truth.json", help="Close the true box in physics, not the inferred one."),
    ] = None,
    crease: Annotated[
        str | None, typer.Option("--crease", metavar="CLASS", help="Class of creases: pre_broken, ordinary, stiff.")
    ] = None,
    video: Annotated[bool, typer.Option("--video", help="Draw simulation.gif too.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Infer the box of one cloud, plan its closing and close it in physics.

    Writes DIR/NAME/ as `infer` does and DIR/NAME/plan/ as `plan` and `simulate` do. Exit status 0 when every flap is
    closed in the end, 3 when one is not.

    [bold]Examples[/]

    boxwright close frame.pcd --robot viper_s850 --place-robot -o out

    boxwright close frame.pcd --robot viper_s850 --camera-pose camera.json --truth frame.truth.json -o out
    """
    import time

    from boxwright.answers import save_answer
    from boxwright.cli.plan_report import NOT_CLOSED, exit_status, print_plan
    from boxwright.cli.plan_steps import base_pose, make_plan, require_place, save_plan_folder
    from boxwright.cli.simulate_report import all_held, draw, print_run
    from boxwright.io.simulations import save_simulation
    from boxwright.io.truth import load_truth
    from boxwright.simulation.physics import CREASE
    from boxwright.simulation.physics import simulate as simulate_plan

    require_place(camera_pose, place_robot)
    start = time.perf_counter()
    read = reading.read(cloud)
    inferred = model.infer(read, looking, time.perf_counter() - start)
    folder = output / cloud.stem
    save_answer(inferred, folder, cloud.stem)
    pose = base_pose(inferred.model, robot, camera_pose, place_robot, object_index)
    made = make_plan(inferred.model, robot, pose, object_index, scene, planner)
    files = save_plan_folder(made, inferred.model, pose, folder / "plan")
    print_plan(made, files, as_json=as_json)
    run = simulate_plan(
        made,
        inferred.model,
        None if truth is None else load_truth(truth),
        crease=crease or CREASE,
        robot=robot if robot.endswith(".toml") else None,
        stills_per_s=10.0 if video else 4.0,
    )
    save_simulation(run.simulation, folder / "plan" / "simulation.json")
    drawn = draw(run, folder / "plan", picture=True, video=video)
    print_run(run.simulation, made.order, [folder / "plan" / "simulation.json", *drawn], as_json=as_json)
    if exit_status(made) or not all_held(run.simulation, made.order):
        raise typer.Exit(NOT_CLOSED)
