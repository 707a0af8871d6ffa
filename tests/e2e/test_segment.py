"""`boxwright segment`: files, tables, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from boxwright import _core
from boxwright.io.clouds import read_cloud, write_pcd
from boxwright.io.segments import load_segments, read_segment_labels
from support.command import boxwright
from support.repository import REPOSITORY


@pytest.mark.parametrize("planes", _core.PLANES)
def test_a_frame_becomes_segments_labels_and_a_picture(frame: Path, planes: str, tmp_path: Path) -> None:
    answer = boxwright("segment", frame, "-o", tmp_path, "--planes", planes, "--verbose")
    assert (answer.status, answer.err) == (0, "")
    folder = tmp_path / "small_0000"
    names = {"segments.json", "labels.npz", "small_0000_segments.png"}
    assert {path.name for path in folder.iterdir()} == names
    assert all(name in answer.out for name in names)
    assert (folder / "small_0000_segments.png").read_bytes().startswith(b"\x89PNG")

    content = json.loads((folder / "segments.json").read_text())
    jsonschema.validate(content, json.loads((REPOSITORY / "docs/schemas/segments.schema.json").read_text()))
    found = load_segments(folder / "segments.json")
    labels = read_segment_labels(folder / "labels.npz")
    assert len(found.segments) > 5
    assert len(labels) == found.source.points == 640 * 480
    counts = np.bincount(labels[labels >= 0], minlength=len(found.segments))
    assert counts.tolist() == [segment.points for segment in found.segments]
    points = read_cloud(frame).points
    for k, segment in enumerate(found.segments):
        heights = points[labels == k].astype(np.float64) @ segment.normal - segment.distance
        assert np.sqrt(np.mean(heights**2)) < 0.03
        for corner in (*segment.rectangle, *segment.hull):
            assert abs(np.dot(corner, segment.normal) - segment.distance) < 1e-6


def test_the_front_ends_differ_in_infer_and_evaluate_too(
    scene_set: Path, carton: tuple[str, ...], tmp_path: Path
) -> None:
    frame = scene_set / "small_0000.pcd"
    stages = []
    for planes in _core.PLANES:
        assert boxwright("infer", frame, "-o", tmp_path / planes, *carton, "--planes", planes).status == 0
        stages.append(set(json.loads((tmp_path / planes / "small_0000/model.json").read_text())["seconds"]["stages"]))
        assert boxwright("evaluate", scene_set, *carton, "--planes", planes).status == 0
    assert len(stages) == 2
    assert stages[0] != stages[1]


def test_an_unorganized_cloud_has_a_picture_too(frame: Path, tmp_path: Path) -> None:
    points = read_cloud(frame).points
    bare = points[np.isfinite(points).all(axis=1)][::4]
    write_pcd(tmp_path / "bare.pcd", bare, width=len(bare), height=1)
    answer = boxwright("segment", tmp_path / "bare.pcd", "-o", tmp_path / "out", "--json")
    assert answer.status == 0, answer.err
    (told,) = json.loads(answer.out)
    assert told["segments"] == len(load_segments(tmp_path / "out/bare/segments.json").segments) > 5
    assert {Path(path).name for path in told["files"]} == {"segments.json", "labels.npz", "bare_segments.png"}
    assert all(Path(path).is_file() for path in told["files"])
    kinds = {kind for s in load_segments(tmp_path / "out/bare/segments.json").segments for kind in s.edges}
    assert kinds == {"edge", "crease"}


def test_bad_inputs_keep_no_other_waiting(frame: Path, tmp_path: Path) -> None:
    (tmp_path / "text.ply").write_text("this is no cloud\n")
    answer = boxwright("segment", tmp_path / "gone.pcd", tmp_path / "text.ply", frame, "-o", tmp_path, "--no-figure")
    assert answer.status == 1
    gone, text = answer.err.splitlines()
    assert "gone.pcd: No such file" in gone
    assert "text.ply" in text
    assert load_segments(tmp_path / "small_0000/segments.json").segments
    assert not (tmp_path / "small_0000/small_0000_segments.png").exists()


WRONG_COMMAND_LINES = (
    ("segment",),
    ("segment", "a.pcd"),
    ("segment", "a.pcd", "b/a.ply", "-o", "out"),
    ("segment", "a.pcd", "-o", "out", "--planes", "magic"),
    ("segment", "a.pcd", "-o", "out", "--up", "0,0"),
    ("infer", "a.pcd", "-o", "out", "--planes", "magic"),
    ("train", "set", "--template", "carton", "-o", "w.json", "--planes", "magic"),
)


@pytest.mark.parametrize("arguments", WRONG_COMMAND_LINES, ids=" ".join)
def test_wrong_command_lines(arguments: tuple[str, ...], tmp_path: Path) -> None:
    answer = boxwright(*arguments, folder=tmp_path)
    assert answer.status == 2, answer
    assert answer.err
    assert list(tmp_path.iterdir()) == []
