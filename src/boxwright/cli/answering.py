"""One input of `boxwright infer` or `boxwright close`, a cloud or a file of frames and poses, from reading to files."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from boxwright.cli.infer_report import Told
    from boxwright.cli.options import ModelOptions, ReadOptions, SceneOptions
    from boxwright.pipeline import Inferred
    from boxwright.types import Cloud, KnownSize


@dataclass(frozen=True)
class Answered:
    """The answer and its files, in `folder` by `name`; the cloud, or the first frame's, and what is told of it."""

    told: Told
    files: tuple[Path, ...]
    folder: Path
    name: str
    cloud: Cloud
    first: Inferred


@dataclass(frozen=True)
class Answering:
    """How inputs are read, what is looked for in them, and where answers go: DIR/NAME, by suffixes of exports."""

    model: ModelOptions
    reading: ReadOptions
    scene: SceneOptions
    sizes: tuple[KnownSize, ...]
    output: Path
    formats: Sequence[str] = ("urdf",)

    def of_cloud(self, path: Path) -> Answered:
        """Raises as `read_cloud`, `infer` and `save_answer` do."""
        from boxwright.answers import save_answer
        from boxwright.cli.infer_report import Told

        start = time.perf_counter()
        cloud = self.reading.read(path)
        inferred = self.model.infer(cloud, self.scene, time.perf_counter() - start, self.sizes)
        folder = self.output / path.stem
        files = save_answer(inferred, folder, path.stem, self.formats)
        return Answered(Told(inferred.model, inferred.refused), files, folder, path.stem, cloud, inferred)

    def of_poses(self, path: Path) -> Answered:
        """Raises as `read_poses`, `read_cloud`, `infer_frames` and `save_fused` do."""
        from boxwright.answers import save_fused
        from boxwright.cli.frames import name_of_poses, read_frames
        from boxwright.cli.infer_report import Told

        start = time.perf_counter()
        frames = read_frames(path, self.reading)
        fused = self.model.infer_frames(frames, self.scene, time.perf_counter() - start, self.sizes, path.name)
        name = name_of_poses(path)
        folder = self.output / name
        files = save_fused(fused, folder, name, self.formats)
        return Answered(Told(fused.model, fused.refused), files, folder, name, frames[0].cloud, fused.first)
