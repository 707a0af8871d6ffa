"""`boxwright close`: from a cloud to a closed box, in physics."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import JsonOption, ModelOptions, ReadOptions, SceneOptions
from boxwright.cli.plan_options import PlanOptions


@grouped
def close(
    cloud: Annotated[Path, typer.Argument(metavar="CLOUD", help="A cloud: .pcd, .ply, .npy, or a depth image .png.")],
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder to write to.")],
    planning: PlanOptions,
    model: ModelOptions,
    reading: ReadOptions,
    looking: SceneOptions,
    truth: Annotated[
        Path | None,
        typer.Option("--truth", metavar="NAME.truth.json", help="Close the true box in physics, not the inferred one."),
    ] = None,
    replan: Annotated[
        bool, typer.Option("--replan", help="After each flap look again with the simulated sensor, and plan anew.")
    ] = False,
    video: Annotated[bool, typer.Option("--video", help="Draw simulation.gif too.")] = False,
    as_json: JsonOption = False,
) -> None:
    """Infer the box of one cloud, plan its closing and close it in physics.

    Writes DIR/NAME/ as `infer` does and DIR/NAME/plan/ as `plan` and `simulate` do; with --replan also each look's
    model and plan, DIR/NAME/plan/look_1 and on. What --scene tells of stands in physics too. Exit status 0 when every
    flap is closed in the end, 3 when one is not.

    [bold]Examples[/]

    boxwright close frame.pcd --robot viper_s850 --place-robot -o out

    boxwright close frame.pcd --robot viper_s850 --camera-pose camera.json --truth frame.truth.json --replan -o out
    """
    import time

    from boxwright.answers import save_answer
    from boxwright.cli.acting import act_at_once, act_looking
    from boxwright.cli.plan_report import NOT_CLOSED, exit_status, print_plan
    from boxwright.cli.plan_steps import save_plan_folder
    from boxwright.cli.simulate_report import all_held, draw, print_run
    from boxwright.io.simulations import save_simulation
    from boxwright.io.truth import load_truth
    from boxwright.robots import robot_file
    from boxwright.simulation.physics import CREASE, staged_plan

    planning.require_place()
    planning.settings()
    start = time.perf_counter()
    read = reading.read(cloud)
    inferred = model.infer(read, looking, time.perf_counter() - start)
    folder = output / cloud.stem
    save_answer(inferred, folder, cloud.stem)
    pose = planning.base_pose(inferred.model)
    made = planning.make(inferred.model, pose)
    files = save_plan_folder(made, inferred.model, pose, folder / "plan")
    print_plan(made, files, as_json=as_json)
    if not made.segments:
        raise typer.Exit(exit_status(made))
    crease = planning.crease or CREASE
    staged = staged_plan(
        made,
        inferred.model,
        None if truth is None else load_truth(truth),
        crease=crease,
        robot=robot_file(planning.robot),
        scene=planning.things(),
        stills_per_s=10.0 if video else 4.0,
    )
    if replan:
        done = act_looking(
            staged, made, inferred.model, crease, lambda seen: model.infer(seen, looking).model, planning.robot,
            scene=planning.things(), settings=planning.settings(),
        )  # fmt: skip
    else:
        done = act_at_once(staged, made, crease)
    files = done.save_looks(folder / "plan")
    save_simulation(done.run.simulation, folder / "plan" / "simulation.json")
    files += [folder / "plan" / "simulation.json", *draw(done.run, folder / "plan", picture=True, video=video)]
    print_run(done.run.simulation, done.order, files, as_json=as_json)
    if exit_status(made) or not all_held(done.run.simulation, done.order):
        raise typer.Exit(NOT_CLOSED)
