"""Scene sets on disk: NAME.pcd, NAME.truth.json and NAME.labels.npz for each frame (docs/formats.md)."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from boxwright.io.clouds import write_pcd
from boxwright.io.truth import save_truth, write_truth_labels
from boxwright.simulation.drawing import CATEGORIES
from boxwright.simulation.frames import Frame, make_frame

VIEWPOINT = (0.0, 0.0, 0.0)


def write_set(
    directory: str | os.PathLike[str],
    count: int,
    seed: int,
    categories: Sequence[str] = CATEGORIES,
    *,
    boxes: int | None = None,
    clutter: bool = True,
    start: int = 0,
    on_frame: Callable[[Frame], None] = lambda _frame: None,
) -> list[str]:
    """Write frames `start` .. `start + count` of a seed's sequence, the categories in turn; their names, in order.

    A set can be made longer later: frame i is the same however many are asked for. `on_frame` is told of each in order.

    Raises ValueError for a category that is not known, OSError when a file cannot be written.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)

    def make(index: int) -> Frame:
        frame = make_frame(categories[index % len(categories)], seed, index, boxes=boxes, clutter=clutter)
        write_frame(folder, frame)
        return frame

    names = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for frame in pool.map(make, range(start, start + count)):
            names.append(frame.truth.name)
            on_frame(frame)
    return names


def write_frame(folder: Path, frame: Frame) -> None:
    """The three files of one frame."""
    name = frame.truth.name
    write_pcd(
        folder / f"{name}.pcd",
        frame.points,
        width=frame.width,
        height=frame.height,
        colors=frame.colors,
        viewpoint=VIEWPOINT,
    )
    save_truth(frame.truth, folder / f"{name}.truth.json")
    write_truth_labels(frame.labels, folder / f"{name}.labels.npz")
