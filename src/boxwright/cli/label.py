"""`boxwright label`: from clouds and what a person says of their segments to labelled frames."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from boxwright.cli.groups import grouped
from boxwright.cli.options import CloudsArgument, JsonOption, ReadOptions, SceneOptions
from boxwright.cli.segment import FigureOption


@grouped
def label(
    clouds: CloudsArgument,
    output: Annotated[Path, typer.Option("-o", "--output", metavar="SET", help="Folder of labelled frames.")],
    template: Annotated[
        str, typer.Option("--template", metavar="NAME|FILE.toml", help="Template whose parts the roles are.")
    ],
    reading: ReadOptions,
    scene: SceneOptions,
    category: Annotated[
        str | None,
        typer.Option("--category", help="Category of the frames, for train and evaluate; default: template."),
    ] = None,
    ask: Annotated[bool, typer.Option("--ask", help="Ask for the roles here, on the terminal.")] = False,
    no_box: Annotated[
        bool, typer.Option("--no-box", help="Nothing in these frames is such an object: label them so at once.")
    ] = False,
    figure: FigureOption = True,
    as_json: JsonOption = False,
) -> None:
    """Label your own frames for training: say which segment is base, side or flap.

    Give the command [bold]twice[/]. The first time it writes, for each CLOUD, SET/forms/NAME/ with a numbered picture
    of the segments and a form, [bold]NAME.roles.toml[/], in which you type the roles. The second time it writes
    SET/NAME.pcd, NAME.truth.json and NAME.labels.npz, which train and evaluate read. A form can be changed and the
    command given again at any time. A few frames without the object (--no-box) teach what is none.

    [bold]Examples[/]

    boxwright label frame_*.pcd -o my_set --template carton

    boxwright label frame.pcd -o my_set --template carton --ask

    boxwright label empty_floor.pcd -o my_set --template carton --no-box

    boxwright train my_set --template carton --planes grid -o mine.json
    """
    from boxwright.cli.label_report import print_json, print_outcome
    from boxwright.cli.label_steps import LabelSteps
    from boxwright.cli.outcome import answer_each, refuse_shared_names
    from boxwright.cli.pictures import segments_figure_drawer
    from boxwright.models import load_template

    refuse_shared_names(clouds)
    _refuse_what_cannot_be(clouds, output, reading, ask and no_box)
    steps = LabelSteps(
        folder=output,
        template=load_template(template),
        category=category,
        read=reading.read,
        scene=scene,
        draw=segments_figure_drawer() if figure and not no_box else None,
    )
    if ask:
        steps.ask_all(clouds)
    outcomes = answer_each(
        clouds, steps.without_box if no_box else steps.next_step, lambda o: print_outcome(o, as_json), 1, "label"
    )
    if as_json:
        print_json(outcomes)
    if any(outcome.refusal for outcome in outcomes):
        raise typer.Exit(1)


def _refuse_what_cannot_be(clouds: list[Path], output: Path, reading: ReadOptions, contradicts: bool) -> None:
    if contradicts:
        raise typer.BadParameter("leaves nothing to ask; leave out --ask or --no-box", param_hint="--no-box")
    if reading.frame == "opengl":
        raise typer.BadParameter(
            "a set's clouds are in the optical frame; turn y and z of the file round first", param_hint="--frame"
        )
    inside = next((path for path in clouds if path.resolve().parent == output.resolve()), None)
    if inside is not None:
        raise typer.BadParameter(
            f"{inside} lies in the set itself, which holds labelled frames alone; move it elsewhere",
            param_hint="CLOUD...",
        )
