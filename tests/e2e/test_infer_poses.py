"""`boxwright infer --poses`: several frames, one model; and why a candidate is no object at `--verbose`."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from boxwright.io.labels import read_labels
from boxwright.io.models import load_model
from boxwright.simulation import write_set
from support.command import boxwright
from support.repository import REPOSITORY


@pytest.fixture(scope="module")
def looks(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The file of poses of a scene with one box, seen from two places."""
    folder = tmp_path_factory.mktemp("looks")
    options = ("--count", "1", "--seed", "31", "--category", "small", "--boxes", "1", "--views", "2")
    answer = boxwright("synth", folder, *options)
    assert answer.status == 0, answer.err
    names = {path.name for path in folder.iterdir()}
    assert {"small_0000.pcd", "small_0000_view1.truth.json", "small_0000.poses.toml"} <= names
    return folder / "small_0000.poses.toml"


def test_frames_come_to_one_model_with_labels_for_each(looks: Path, tmp_path: Path) -> None:
    answer = boxwright("infer", "--poses", looks, "-o", tmp_path)
    assert answer.status == 0, answer.err
    folder = tmp_path / "small_0000"
    content = json.loads((folder / "model.json").read_text())
    jsonschema.validate(content, json.loads((REPOSITORY / "docs/schemas/model.schema.json").read_text()))
    model = load_model(folder / "model.json")
    assert model.source.file == looks.name
    assert [frame.file for frame in model.source.frames] == ["small_0000.pcd", "small_0000_view1.pcd"]
    assert model.source.frames[0].input_from_frame.position == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    (found,) = model.objects
    assert (folder / "small_0000_0.urdf").is_file()
    labels = [read_labels(folder / f"labels_{number}.npz") for number in (1, 2)]
    told = sum(np.bincount(one.part[one.object == 0], minlength=len(found.parts)) for one in labels)
    assert [part.points for part in found.parts] == told.tolist()


def test_what_does_not_go_with_frames_is_a_wrong_command_line(looks: Path, frame: Path, tmp_path: Path) -> None:
    refused = (
        ((frame, "--poses", looks), "lists the frames; leave out"),
        (("--poses", looks, "--method", "paper"), "does not fuse frames"),
        ((), "--poses FILE.toml"),
    )
    for arguments, fault in refused:
        answer = boxwright("infer", *arguments, "-o", tmp_path / "out")
        assert answer.status == 2
        assert fault in " ".join(answer.err.replace("│", " ").split()), answer.err
    assert len(refused) == 3
    assert not (tmp_path / "out").exists()


def test_a_bad_file_is_one_line_with_file_and_frame(looks: Path, tmp_path: Path) -> None:
    bad = looks.with_name("bad.toml")
    bad.write_text(looks.read_text().replace("small_0000_view1.pcd", "gone.pcd"))
    answer = boxwright("infer", "--poses", bad, "-o", tmp_path / "out")
    assert answer.status == 1
    assert answer.err.strip().splitlines()[-1].startswith(f"boxwright: {bad}: frame 2: gone.pcd: there is no such file")


def test_verbose_says_why_a_candidate_is_no_object(tmp_path: Path) -> None:
    (name,) = write_set(tmp_path, 1, 3002, ("none",), start=5)
    quiet, verbose = (boxwright("infer", tmp_path / f"{name}.pcd", "-o", tmp_path, *v) for v in ((), ("--verbose",)))
    assert load_model(tmp_path / name / "model.json").objects == ()
    assert "no object at" not in quiet.out
    assert "that it is a box has probability" in " ".join(verbose.out.split())
