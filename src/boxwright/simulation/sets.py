"""Scene sets on disk: NAME.pcd, NAME.truth.json and NAME.labels.npz for each frame (docs/formats.md).

NAME.poses.toml lists the frames of a scene that was seen from several places."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path

from boxwright.io.clouds import write_pcd
from boxwright.io.poses import write_poses
from boxwright.io.truth import save_truth, write_truth_labels
from boxwright.parallel import ordered_map, processors
from boxwright.simulation.drawing import CATEGORIES
from boxwright.simulation.frames import Frame, check_request
from boxwright.simulation.looks import Look, make_looks
from boxwright.types import PosedFile

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
) -> list[str]:
    """`write_frames` to its end; the names of the frames, in order."""
    frames = write_frames(directory, count, seed, categories, boxes=boxes, clutter=clutter, start=start)
    return [frame.truth.name for frame in frames]


def write_frames(
    directory: str | os.PathLike[str],
    count: int,
    seed: int,
    categories: Sequence[str] = CATEGORIES,
    *,
    boxes: int | None = None,
    clutter: bool = True,
    start: int = 0,
    views: int = 1,
) -> Iterator[Frame]:
    """Write frames `start` .. `start + count` of a seed's sequence, the categories in turn; yields each once written.

    A set can be made longer later: frame i is the same however many are asked for. With more than one of `views` each
    scene is seen from further places too, NAME_view1 and so on, and NAME.poses.toml lists its frames; the first is
    yielded.

    Raises ValueError for a category that is not known, none at all or no view, OSError when a file cannot be written.
    """
    if not categories:
        raise ValueError(f"categories is empty; must name one or more of {', '.join(CATEGORIES)}, none")
    for category in categories:
        check_request(category, seed, start, boxes)
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)

    def make(index: int) -> Frame:
        category = categories[index % len(categories)]
        looks = make_looks(category, seed, index, views, boxes=boxes, clutter=clutter)
        for look in looks:
            write_frame(folder, look.frame)
        if views > 1:
            write_looks(folder, looks)
        return looks[0].frame

    return ordered_map(make, range(start, start + count), processors())


def write_looks(folder: Path, looks: Sequence[Look]) -> None:
    """NAME.poses.toml of a scene whose frames are in the folder, named as its first frame."""
    names = [look.frame.truth.name for look in looks]
    files = zip(names, looks, strict=True)
    poses = [PosedFile(file=Path(f"{name}.pcd"), base_from_camera=look.base_from_camera) for name, look in files]
    write_poses(folder / f"{names[0]}.poses.toml", poses)


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
    write_truth_labels(frame.labels, folder / f"{name}.labels.npz", frame.faces)
