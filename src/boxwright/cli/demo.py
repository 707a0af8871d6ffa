"""`boxwright demo`: the whole way once, on a made-up frame whose truth is known."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from boxwright.cli.pictures import Drawer
    from boxwright.evaluation import FrameScore
    from boxwright.pipeline import Inferred
    from boxwright.simulation import Frame

NAME = "frame"

CATEGORY = "medium"

SEED = 24
"""The first seed whose frame shows the base, all four flaps and three sides, each by 400 readings or more."""


def demo(
    output: Annotated[Path, typer.Option("-o", "--output", metavar="DIR", help="Folder for everything.")] = Path(
        "out/demo"
    ),
    seed: Annotated[int, typer.Option("--seed", min=0, help="Another seed, another frame.")] = SEED,
) -> None:
    """Make a frame by simulation, infer its box and compare the flaps' angles with the truth.

    Writes the frame (cloud, truth, labels) and the answer (model, labels, URDF, picture); says where they are.
    """
    from boxwright.cli.demo_report import print_comparison, print_files
    from boxwright.cli.pictures import frame_figure_drawer
    from boxwright.simulation import make_frame, write_frame

    draw = frame_figure_drawer()
    frame = make_frame(CATEGORY, seed, boxes=1, name=NAME)
    output.mkdir(parents=True, exist_ok=True)
    write_frame(output, frame)
    inferred, files = _understand(output, draw)
    print_comparison(frame.truth, _score(inferred, frame), inferred.model)
    print_files(output, NAME, files)


def _understand(output: Path, draw: Drawer) -> tuple[Inferred, tuple[Path, ...]]:
    """What is inferred from the frame's file, and the files that this makes."""
    from boxwright.answers import save_answer
    from boxwright.io.clouds import read_cloud
    from boxwright.models import TEMPLATE_NAMES
    from boxwright.pipeline import infer

    cloud = read_cloud(output / f"{NAME}.pcd")
    inferred = infer(cloud)
    files = save_answer(inferred, output / NAME, NAME)
    picture = output / NAME / f"{NAME}.png"
    draw(cloud, inferred, picture, TEMPLATE_NAMES)
    return inferred, (*files, picture)


def _score(inferred: Inferred, frame: Frame) -> FrameScore:
    from boxwright.evaluation import score_frame

    objects = inferred.model.objects
    return score_frame(objects, inferred.object_labels, inferred.part_labels, frame.truth, frame.labels)
