"""Several frames of one scene as a command's input."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

from boxwright.cli.outcome import refuse_shared_names

if TYPE_CHECKING:
    from boxwright.cli.options import ModelOptions, ReadOptions
    from boxwright.types import PosedCloud


def inputs_of(clouds: list[Path] | None, poses: Path | None, model: ModelOptions) -> list[Path]:
    """The clouds, or the file that lists frames and poses. Raises typer.BadParameter where it is not one of both."""
    if poses is None:
        if not clouds:
            raise typer.BadParameter("give clouds, or --poses FILE.toml", param_hint="CLOUD...")
        refuse_shared_names(clouds)
        return clouds
    if clouds:
        raise typer.BadParameter(
            f"{poses} lists the frames; leave out {', '.join(map(str, clouds))}", param_hint="--poses"
        )
    model.refuse_for_frames()
    return [poses]


def read_frames(poses: Path, reading: ReadOptions) -> list[PosedCloud]:
    """The frames that a file of poses lists. Raises OSError, and ValueError naming file, frame and mend."""
    from boxwright.io.poses import read_poses
    from boxwright.types import PosedCloud

    frames = []
    for number, listed in enumerate(read_poses(poses), start=1):
        try:
            frames.append(PosedCloud(cloud=reading.read(listed.file), base_from_camera=listed.base_from_camera))
        except ValueError as error:
            raise ValueError(f"{poses}: frame {number}: {error}") from None
    return frames


def name_of_poses(poses: Path) -> str:
    """NAME of the answer to NAME.toml, and to NAME.poses.toml."""
    return poses.stem.removesuffix(".poses") or poses.stem
