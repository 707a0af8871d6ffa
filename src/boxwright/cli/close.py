"""`boxwright close`: from a cloud to a closed box, in physics."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.known_options import KnownOptions
from boxwright.cli.options import JsonOption, ModelOptions, PosesOption, ReadOptions, SceneOptions, VerboseOption
from boxwright.cli.plan_options import PlanOptions

if TYPE_CHECKING:
    from boxwright.types import Cloud, Model


@grouped
def close(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder to write to.")],
    planning: PlanOptions,
    model: ModelOptions,
    reading: ReadOptions,
    looking: SceneOptions,
    known: KnownOptions,
    cloud: Annotated[
        Path | None, typer.Argument(metavar="CLOUD", help="A cloud: .pcd, .ply, .npy, or a depth image .png.")
    ] = None,
    poses: PosesOption = None,
    truth: Annotated[
        Path | None,
        typer.Option("--truth", metavar="NAME.truth.json", help="Close the true box in physics, not the inferred one."),
    ] = None,
    replan: Annotated[
        bool, typer.Option("--replan", help="After each flap look again with the simulated sensor, and plan anew.")
    ] = False,
    video: Annotated[bool, typer.Option("--video", help="Draw simulation.gif too.")] = False,
    as_json: JsonOption = False,
    verbose: VerboseOption = False,
) -> None:
    """Infer the box of one cloud, or of several frames of it, plan its closing and close it in physics.

    Writes DIR/NAME/ as `infer` does and DIR/NAME/plan/ as `plan` and `simulate` do; with --replan also each look's
    model and plan, DIR/NAME/plan/look_1 and on. What an earlier plan left there is removed. What --scene tells of
    stands in physics too; what --size and --catalogue tell of counts at every look. --verbose prints what `infer` does.

    Exit status 0 when every flap is closed in the end, 3 when one is not. With --replan the flaps that the box in
    physics has count, whatever the first plan said; without it also those that could not be planned, but for a hidden
    one that the true box does not have.

    [bold]Examples[/]

    boxwright close frame.pcd --robot viper_s850 --place-robot -o out

    boxwright close frame.pcd --robot viper_s850 --camera-pose camera.json --truth frame.truth.json --replan -o out

    boxwright close frame.pcd --robot viper_s850 --place-robot --size 400x300x200 -o out
    """
    from boxwright.cli.acting import act_at_once, act_looking
    from boxwright.cli.answering import Answering
    from boxwright.cli.frames import inputs_of
    from boxwright.cli.infer_report import print_json, print_outcome
    from boxwright.cli.leftovers import remove_plan
    from boxwright.cli.outcome import Outcome
    from boxwright.cli.plan_report import NOT_CLOSED, exit_status, print_plan
    from boxwright.cli.plan_steps import save_plan_folder
    from boxwright.cli.simulate_report import all_as_planned, all_closed, draw, print_run
    from boxwright.io.simulations import save_simulation
    from boxwright.io.truth import load_truth
    from boxwright.robots import robot_file
    from boxwright.simulation.physics import CREASE, staged_plan

    (source,) = inputs_of(None if cloud is None else [cloud], poses, model)
    planning.refuse_unfit()
    model.refuse_unfit(looking)
    sizes = known.sizes(model.method_name)
    true = None if truth is None else load_truth(truth)
    answering = Answering(model, reading, looking, sizes, output)
    answered = answering.of_cloud(source) if poses is None else answering.of_poses(source)
    found, folder = answered.told.model, answered.folder
    remove_plan(folder / "plan")
    if verbose:
        told = Outcome(source, answered.told, answered.files)
        print_outcome(told, verbose, as_json)
        if as_json:
            print_json([told], verbose)
    pose = planning.base_pose(found)
    made = planning.make(found, pose)
    files = save_plan_folder(made, found, pose, folder / "plan")
    print_plan(made, files, as_json=as_json)
    if not made.segments and not replan:
        raise typer.Exit(exit_status(made))
    crease = planning.crease or CREASE
    staged = staged_plan(
        made,
        found,
        true,
        crease=crease,
        robot=robot_file(planning.robot),
        scene=planning.things(),
        stills_per_s=10.0 if video else 4.0,
    )
    if replan:

        def infer_again(seen: Cloud) -> Model:
            return model.infer(seen, looking, sizes=sizes).model

        done = act_looking(
            staged, made, found, crease, infer_again, planning.robot,
            scene=planning.things(), settings=planning.settings(),
        )  # fmt: skip
    else:
        done = act_at_once(staged, made, crease)
    files = done.save_looks(folder / "plan")
    save_simulation(done.run.simulation, folder / "plan" / "simulation.json")
    files += [folder / "plan" / "simulation.json", *draw(done.run, folder / "plan", picture=True, video=video)]
    print_run(done.run.simulation, done.order, files, as_json=as_json)
    if not (all_closed(done.run.simulation) if replan else all_as_planned(done.run.simulation, made)):
        raise typer.Exit(NOT_CLOSED)
