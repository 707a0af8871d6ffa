"""Scene sets: every frame of a folder with its truth and labels, and clear words where a partner is missing."""

from __future__ import annotations

import shutil
from pathlib import Path

import msgspec
import numpy as np
import pytest

from boxwright.evaluation import list_set, read_set
from boxwright.io.truth import save_truth, write_truth_labels
from boxwright.types import Truth
from support.labelled_scenes import perfect_scene
from support.random_models import random_angles, random_spec


def made_up_truth() -> Truth:
    rng = np.random.default_rng(8)
    spec = random_spec(rng)
    return perfect_scene([(spec, random_angles(spec, rng), {})]).truth


def write_frame(folder: Path, name: str, truth: Truth, highest: int = 1, suffix: str = ".pcd") -> None:
    (folder / f"{name}{suffix}").touch()
    save_truth(truth, folder / f"{name}.truth.json")
    write_truth_labels(np.arange(highest + 1, dtype=np.uint16), folder / f"{name}.labels.npz")


def test_frames_come_in_the_order_of_their_names(tmp_path: Path) -> None:
    truth = made_up_truth()
    for name, suffix in (("b.2", ".ply"), ("a", ".pcd"), ("c", ".PCD")):
        write_frame(tmp_path, name, truth, suffix=suffix)
    (tmp_path / "README.md").touch()
    frames = list(read_set(tmp_path))
    assert [frame.name for frame in frames] == ["a", "b.2", "c"]
    assert [frame.cloud_path.name for frame in frames] == ["a.pcd", "b.2.ply", "c.PCD"]
    assert frames[0].truth == truth
    np.testing.assert_array_equal(frames[0].labels, [0, 1])


@pytest.mark.parametrize(
    ("missing", "told"), [("a.pcd", "a.pcd"), ("a.truth.json", "a.truth.json"), ("a.labels.npz", "a.labels.npz")]
)
def test_a_missing_partner_is_named_before_anything_is_read(tmp_path: Path, missing: str, told: str) -> None:
    write_frame(tmp_path, "a", made_up_truth())
    (tmp_path / missing).unlink()
    with pytest.raises(ValueError, match=f"a: {told} is missing") as caught:
        read_set(tmp_path)
    assert str(caught.value).startswith(f"{tmp_path}: ")


def test_two_clouds_of_one_frame_and_an_empty_folder_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="no frame in it"):
        list_set(tmp_path)
    write_frame(tmp_path, "a", made_up_truth())
    (tmp_path / "a.ply").touch()
    with pytest.raises(ValueError, match=r"has a\.pcd and a\.ply; must be one"):
        list_set(tmp_path)
    with pytest.raises(FileNotFoundError):
        list_set(tmp_path / "nowhere")


def test_labels_and_boxes_that_are_not_there_are_refused(tmp_path: Path) -> None:
    truth = made_up_truth()
    write_frame(tmp_path, "a", truth, highest=len(truth.parts) + 1)
    with pytest.raises(ValueError, match=r"a\.labels\.npz: labels go to"):
        list(read_set(tmp_path))
    write_frame(tmp_path, "a", msgspec.structs.replace(truth, boxes=()))
    with pytest.raises(ValueError, match=r"a\.truth\.json: parts: base is of box 0"):
        list(read_set(tmp_path))


def test_the_shared_set_is_read_whole(shared_dir: Path, tmp_path: Path) -> None:
    folder = shared_dir / "data" / "labelled"
    frames = list(read_set(folder))
    assert len(frames) == 14
    assert sum(len(frame.truth.boxes) for frame in frames) == 16
    assert all(frame.labels.shape == (640 * 480,) for frame in frames)
    shutil.copy(folder / "small_000.pcd", tmp_path)
    with pytest.raises(ValueError, match=r"small_000\.truth\.json is missing"):
        read_set(tmp_path)
