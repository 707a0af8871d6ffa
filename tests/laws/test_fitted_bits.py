"""The method fitted gives the same answer each time, on one thread or two: frames side by side, and within a frame."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import msgspec
import pytest

from boxwright.evaluation import list_set
from boxwright.io.labels import read_labels
from boxwright.io.models import load_model
from boxwright.scoring import score_entries
from boxwright.simulation.sets import write_set

INFER = """
import sys
from pathlib import Path
from boxwright import infer, read_cloud
from boxwright.answers import save_answer

for cloud in sorted(Path(sys.argv[1]).glob("*.pcd")):
    save_answer(infer(read_cloud(cloud), method="fitted"), Path(sys.argv[2]) / cloud.stem, cloud.stem)
"""


def test_frames_side_by_side_change_no_bit(tmp_path: Path) -> None:
    write_set(tmp_path, count=6, seed=77)
    entries = list_set(tmp_path)
    one, two, again = (
        [outcome.score for outcome in score_entries(entries, method="fitted", templates=None, weights=None, jobs=jobs)]
        for jobs in (1, 2, 2)
    )
    assert one == two == again
    assert sum(len(score.boxes) for score in one if score is not None) >= 6


def test_threads_within_a_frame_change_no_bit(tmp_path: Path) -> None:
    """Whole answers of processes whose core has one thread and two."""
    frames = tmp_path / "frames"
    write_set(frames, count=2, seed=77, categories=("medium", "carton"))
    _answers_are_alike(frames, tmp_path, least_objects=2)


def test_threads_within_a_labelled_frame_change_no_bit(shared_dir: Path, tmp_path: Path) -> None:
    frames = tmp_path / "frames"
    frames.mkdir()
    clouds = sorted((shared_dir / "data" / "labelled").glob("*.pcd"))[:2]
    if len(clouds) < 2:
        pytest.skip("the labelled frames are not there")
    for cloud in clouds:
        (frames / cloud.name).symlink_to(cloud.resolve())
    _answers_are_alike(frames, tmp_path, least_objects=2)


def _answers_are_alike(frames: Path, folder: Path, least_objects: int) -> None:
    for threads in ("1", "2"):
        told = {**os.environ, "RAYON_NUM_THREADS": threads}
        subprocess.run([sys.executable, "-c", INFER, frames, folder / threads], env=told, check=True, timeout=300)
    objects, files = 0, 0
    for path in sorted((folder / "1").rglob("*")):
        other = folder / "2" / path.relative_to(folder / "1")
        if path.name == "model.json":
            one, two = (msgspec.structs.replace(load_model(each), seconds=None) for each in (path, other))
            assert msgspec.json.encode(one) == msgspec.json.encode(two), path
            objects += len(one.objects)
        elif path.name == "labels.npz":
            one, two = read_labels(path), read_labels(other)
            assert one.object.tobytes() == two.object.tobytes(), path
            assert one.part.tobytes() == two.part.tobytes(), path
        elif path.is_file():
            assert path.read_bytes() == other.read_bytes(), path
        files += path.is_file()
    assert objects >= least_objects
    assert files == sum(path.is_file() for path in (folder / "2").rglob("*")) == 4 + objects
