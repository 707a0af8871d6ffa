"""`boxwright synth`: make a scene set."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def synth(
    directory: Annotated[
        Path, typer.Argument(help="Folder to write NAME.pcd, NAME.truth.json and NAME.labels.npz to.")
    ],
    count: Annotated[int, typer.Option(min=1, help="How many frames.")],
    seed: Annotated[int, typer.Option(min=0, help="Names the sequence of frames: same seed, same frames.")] = 0,
    category: Annotated[
        list[str] | None,
        typer.Option(
            help="small, medium, large, carton, cake, pizza (the default: these six in turn), tote (no flaps), upright "
            "(all flaps stand up), part_shut (some are shut), lying (on a side), closed, or none (no box). Repeatable."
        ),
    ] = None,
    boxes: Annotated[
        int | None, typer.Option(min=1, max=3, help="Open boxes in each frame, but for none; default: drawn.")
    ] = None,
    start: Annotated[int, typer.Option(min=0, help="First frame of the sequence; to make a set longer.")] = 0,
    views: Annotated[
        int,
        typer.Option(
            min=1, help="Places that each scene is seen from; NAME.poses.toml lists them where there are several."
        ),
    ] = 1,
    clutter: Annotated[bool, typer.Option("--clutter/--no-clutter", help="Household things around and inside.")] = True,
    as_json: Annotated[bool, typer.Option("--json", help="Print a summary as JSON.")] = False,
) -> None:
    """Make simulated Kinect frames of open boxes, with exact truth.

    A set can be made longer later by --start: frame i of a seed is the same however many are asked for.

    [bold]Examples[/]

    boxwright synth set --count 60 --seed 7

    boxwright synth looks --count 12 --seed 7 --boxes 1 --views 3

    boxwright synth pizzas --count 20 --category pizza --boxes 2 --no-clutter
    """
    import json
    import time

    from boxwright.cli.screen import progress
    from boxwright.simulation import CATEGORIES, write_frames

    began = time.perf_counter()
    frames = write_frames(
        directory, count, seed, tuple(category or CATEGORIES), boxes=boxes, clutter=clutter, start=start, views=views
    )
    truths = [frame.truth for frame in progress(frames, count, "synth")]
    seconds = time.perf_counter() - began
    if as_json:
        summary = {
            "directory": str(directory),
            "seed": seed,
            "seconds": seconds,
            "frames": [truth.name for truth in truths],
        }
        print(json.dumps(summary, indent=1))
    else:
        open_boxes = sum(len(truth.boxes) for truth in truths)
        print(f"{len(truths)} frames with {open_boxes} open boxes in {directory} ({seconds:.1f} s)")
