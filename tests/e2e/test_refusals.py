"""Bad input: one line naming file, place and mend, status 1; a wrong command line: status 2; never a traceback."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from boxwright.io.clouds import read_cloud, write_pcd
from boxwright.io.models import load_model
from support.command import Answer, boxwright


def _one_line(answer: Answer, *words: str) -> None:
    assert answer.status == 1, answer
    (line,) = answer.err.splitlines()
    assert line.startswith("boxwright: ")
    for word in words:
        assert word in line, line


def test_a_missing_file_does_not_keep_the_others_waiting(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    answer = boxwright("infer", tmp_path / "gone.pcd", frame, "-o", tmp_path / "out", *carton)
    _one_line(answer, "gone.pcd: No such file")
    assert load_model(tmp_path / "out/small_0000/model.json").objects


def test_a_truncated_cloud(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    path = tmp_path / "cut.pcd"
    path.write_bytes(frame.read_bytes()[:100_000])
    _one_line(boxwright("infer", path, "-o", tmp_path / "out", *carton), "cut.pcd", "byte")
    assert not (tmp_path / "out").exists()


def test_millimetres_are_refused_and_the_option_mends_it(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    cloud = read_cloud(frame)
    path = tmp_path / "mm.pcd"
    write_pcd(path, cloud.points * np.float32(1000), width=cloud.width, height=cloud.height)
    _one_line(boxwright("infer", path, "-o", tmp_path, *carton), "mm.pcd", "--unit mm")
    assert boxwright("infer", path, "-o", tmp_path, *carton, "--unit", "mm").status == 0
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    in_mm, in_m = (load_model(tmp_path / name / "model.json").objects[0] for name in ("mm", "small_0000"))
    assert in_mm.dimensions == pytest.approx(in_m.dimensions, abs=2e-3)


def test_a_camera_that_looks_backwards(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    cloud = read_cloud(frame)
    path = tmp_path / "gl.pcd"
    turned = cloud.points * np.float32([1, -1, -1])
    write_pcd(path, turned, width=cloud.width, height=cloud.height, viewpoint=(0.0, 0.0, 0.0))
    _one_line(boxwright("infer", path, "-o", tmp_path, *carton), "gl.pcd", "--frame opengl")
    assert boxwright("infer", path, "-o", tmp_path, *carton, "--frame", "opengl", "--figure").status == 0


BAD_FILES = {
    "empty.pcd": b"",
    "text.ply": b"this is no cloud\n",
    "huge.pcd": b"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4000000000\nHEIGHT 4000000\n"
    b"POINTS 16000000000000000\nDATA binary\n",
    "cloud.xyz": b"0 0 0\n",
    "noise.npy": bytes(range(256)),
    "picture.png": b"\x89PNG\r\n\x1a\n",
}


@pytest.mark.parametrize("name", BAD_FILES)
def test_files_that_are_no_clouds(name: str, carton: tuple[str, ...], tmp_path: Path) -> None:
    (tmp_path / name).write_bytes(BAD_FILES[name])
    _one_line(boxwright("infer", tmp_path / name, "-o", tmp_path / "out", *carton), name)


def test_clouds_in_which_nothing_can_be_seen(carton: tuple[str, ...], tmp_path: Path) -> None:
    nothing = np.full((64, 3), np.nan, np.float32)
    write_pcd(tmp_path / "nan.pcd", nothing, width=8, height=8)
    _one_line(boxwright("infer", tmp_path / "nan.pcd", "-o", tmp_path / "out", *carton), "nan.pcd")
    write_pcd(tmp_path / "point.pcd", np.ones((64, 3), np.float32), width=8, height=8)
    answer = boxwright("infer", tmp_path / "point.pcd", "-o", tmp_path / "out", *carton, "--figure")
    assert answer.status in (0, 1)
    assert len(answer.err.splitlines()) <= 1 + answer.err.count("warning")


def test_two_inputs_of_one_name_stop_before_any_work(frame: Path, tmp_path: Path) -> None:
    answer = boxwright("infer", frame, tmp_path / "other/small_0000.ply", "-o", tmp_path / "out")
    assert answer.status == 2
    assert "small_0000" in answer.err
    assert not (tmp_path / "out").exists()


WRONG_COMMAND_LINES = (
    ("nonsense",),
    ("infer",),
    ("infer", "a.pcd"),
    ("infer", "a.pcd", "-o", "out", "--colour"),
    ("infer", "a.pcd", "-o", "out", "--unit", "inch"),
    ("infer", "a.pcd", "-o", "out", "--method", "magic"),
    ("infer", "a.pcd", "-o", "out", "--roi", "1,2"),
    ("infer", "a.pcd", "-o", "out", "--viewpoint", "1,2,high"),
    ("infer", "a.pcd", "-o", "out", "--viewpoint", "0,0,nan"),
    ("infer", "a.pcd", "-o", "out", "--up", "nan,0,1"),
    ("segment", "a.pcd", "-o", "out", "--up", "0,0,0"),
    ("infer", "a.pcd", "-o", "out", "--jobs", "0"),
    ("figure", "a.pcd", "-o", "a.gif"),
    ("train", "set", "-o", "w.json", "--method", "paper"),
    ("evaluate",),
)


@pytest.mark.parametrize("arguments", WRONG_COMMAND_LINES, ids=" ".join)
def test_wrong_command_lines(arguments: tuple[str, ...], tmp_path: Path) -> None:
    answer = boxwright(*arguments, folder=tmp_path)
    assert answer.status == 2, answer
    assert answer.err
    assert list(tmp_path.iterdir()) == []


def test_weights_that_do_not_fit_name_the_key(frame: Path, weights: Path, tmp_path: Path) -> None:
    content = json.loads(weights.read_text())
    del content["weights"]["sides_square"]
    wrong = tmp_path / "wrong.json"
    wrong.write_text(json.dumps(content))
    answer = boxwright(
        "infer", frame, "-o", tmp_path / "out", "--method", "paper", "--template", "carton", "--weights", wrong
    )
    _one_line(answer, "wrong.json", "sides_square")


def test_values_that_do_not_fit(frame: Path, carton: tuple[str, ...], weights: Path, tmp_path: Path) -> None:
    base = ("infer", frame, "-o", tmp_path / "out")
    _one_line(boxwright(*base, *carton, "--roi", "1,0,0,1,0,1"), "roi")
    _one_line(boxwright(*base, "--template", "sofa"), "sofa", "carton")
    _one_line(boxwright("infer", frame, "gone.pcd", "-o", "out", "--template", "sofa"), "sofa", "carton")
    _one_line(boxwright("evaluate", frame.parent, "--template", "sofa"), "sofa", "carton")
    _one_line(boxwright(*base, *carton, "--roi", "8,9,8,9,8,9"), "roi", "holds no reading", "lie in x")
    _one_line(boxwright(*base, "--weights", weights), "template")
    _one_line(boxwright(*base, *carton, "--intrinsics", "camera.json"), "--intrinsics")
    (tmp_path / "file").write_text("")
    _one_line(boxwright("infer", frame, "-o", tmp_path / "file", *carton), "file")


def test_sets_that_are_none(tmp_path: Path) -> None:
    _one_line(boxwright("evaluate", tmp_path), "no frame")
    _one_line(boxwright("evaluate", tmp_path / "gone"), "gone")
    (tmp_path / "a.pcd").write_bytes(b"")
    _one_line(boxwright("train", tmp_path, "--template", "carton", "-o", tmp_path / "w.json"), "a.truth.json")
