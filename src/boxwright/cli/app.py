"""All commands in one place. Their bodies import what they need, so that `--help` is quick."""

from __future__ import annotations

from typing import Annotated

import typer

from boxwright import __version__
from boxwright.cli.calibrate import calibrate
from boxwright.cli.close import close
from boxwright.cli.demo import demo
from boxwright.cli.evaluate import evaluate
from boxwright.cli.explain import explain
from boxwright.cli.figure import figure
from boxwright.cli.infer import infer
from boxwright.cli.label import label
from boxwright.cli.plan import plan
from boxwright.cli.robots import robots
from boxwright.cli.segment import segment
from boxwright.cli.simulate import simulate
from boxwright.cli.synth import synth
from boxwright.cli.train import train

app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode="rich")
for command in (
    demo, infer, segment, explain, figure, label, evaluate, synth, train, calibrate, robots, plan, simulate, close
):  # fmt: skip
    app.command()(command)


def _print_version(wanted: bool) -> None:
    if wanted:
        print(f"boxwright {__version__}")
        raise typer.Exit


@app.callback()
def boxwright(
    version: Annotated[
        bool, typer.Option("--version", callback=_print_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """From one depth frame of an open box to its articulated 3D model.

    Exit status: 0 done, 1 an input or a value could not be used (one line on standard error), 2 a wrong command line.
    """
