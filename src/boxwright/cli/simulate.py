"""`boxwright simulate`: a plan in physics."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.options import JsonOption
from boxwright.cli.plan_options import SceneOption


def simulate(
    plan_dir: Annotated[
        Path, typer.Argument(metavar="PLAN_DIR", help="What `boxwright plan` wrote: plan.json and model.json.")
    ],
    truth: Annotated[
        Path | None,
        typer.Option(metavar="NAME.truth.json", help="Close the true box; without it, the one that was inferred."),
    ] = None,
    crease: Annotated[
        str | None, typer.Option(metavar="CLASS", help="Class of creases, as pre_broken, ordinary (default), stiff.")
    ] = None,
    crease_file: Annotated[
        Path | None, typer.Option(metavar="FILE.toml", help="Your own classes of creases (docs/physics.md).")
    ] = None,
    mass_kg: Annotated[
        float | None,
        typer.Option(min=0.0, help="Box and contents together, 1000 at most; by default contents of 100 kg/m3."),
    ] = None,
    empty: Annotated[bool, typer.Option("--empty", help="Nothing is in the box.")] = False,
    board_mm: Annotated[
        float | None, typer.Option(min=0.1, help="Thickness of the board, 50 at most, before what truth or model tell.")
    ] = None,
    robot: Annotated[
        Path | None, typer.Option(metavar="FILE", help="The plan's robot (.toml, .urdf), where it is not shipped.")
    ] = None,
    time_step_ms: Annotated[float, typer.Option(help="Physics' time step, from 0.05 to 1.")] = 1.0,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="DIR", help="Folder to write to; default: PLAN_DIR.")
    ] = None,
    picture: Annotated[
        bool, typer.Option("--picture/--no-picture", help="Draw simulation.png, moments side by side.")
    ] = True,
    video: Annotated[bool, typer.Option("--video", help="Draw simulation.gif too; slow without a graphics card.")] = (
        False
    ),
    replan: Annotated[
        bool, typer.Option("--replan", help="After each flap look again with the simulated sensor, and plan anew.")
    ] = False,
    scene: SceneOption = None,
    as_json: JsonOption = False,
) -> None:
    """Let the arm follow a plan in physics, and see which flaps are closed and stay closed.

    Writes [bold]simulation.json[/], [bold]simulation.png[/] and with --video [bold]simulation.gif[/]; with --replan
    each look's model and plan too, look_1 and on. Tell the --scene of the plan: its things stand in physics too, and
    with --replan they are planned around. Exit status 0 when every flap that was planned, with --replan every flap that
    the box has, is closed in the end, 3 when one is not.

    [bold]Examples[/]

    boxwright simulate out/plan --truth set/frame.truth.json

    boxwright simulate out/plan --crease stiff --empty --video

    boxwright simulate out/plan --truth set/frame.truth.json --replan
    """
    from boxwright.cli.acting import act_at_once, act_looking
    from boxwright.cli.leftovers import remove_run
    from boxwright.cli.plan_options import crease_settings, read_things
    from boxwright.cli.simulate_report import NOT_CLOSED, all_closed, all_held, draw, print_run
    from boxwright.io.models import load_model
    from boxwright.io.plans import load_plan
    from boxwright.io.simulations import save_simulation
    from boxwright.io.truth import load_truth
    from boxwright.pipeline import infer
    from boxwright.robots.catalogue import robot_file
    from boxwright.simulation.physics import CREASE, Load, PhysicsSettings, staged_plan

    step_s = time_step_ms / 1000.0
    things = read_things(scene)
    plan = load_plan(plan_dir / "plan.json")
    model = load_model(plan_dir / "model.json")
    staged = staged_plan(
        plan,
        model,
        None if truth is None else load_truth(truth),
        crease=crease or CREASE,
        crease_file=crease_file,
        robot=None if robot is None else robot_file(robot),
        load=Load(empty=empty, mass_kg=mass_kg),
        settings=PhysicsSettings(time_step_s=step_s),
        thickness_m=None if board_mm is None else board_mm / 1000.0,
        scene=things,
        stills_per_s=(10.0 if video else 4.0) if picture or video else 0.0,
    )
    if replan:
        done = act_looking(
            staged, plan, model, crease or CREASE, lambda seen: infer(seen).model, robot or plan.robot,
            scene=things, settings=crease_settings(crease, crease_file),
        )  # fmt: skip
    else:
        done = act_at_once(staged, plan, crease or CREASE)
    folder = output or plan_dir
    folder.mkdir(parents=True, exist_ok=True)
    remove_run(folder, keep=plan_dir)
    files = done.save_looks(folder)
    save_simulation(done.run.simulation, folder / "simulation.json")
    files += [folder / "simulation.json", *draw(done.run, folder, picture=picture, video=video)]
    print_run(done.run.simulation, done.order, files, as_json=as_json)
    if not (all_closed(done.run.simulation) if replan else all_held(done.run.simulation, done.order)):
        raise typer.Exit(NOT_CLOSED)
