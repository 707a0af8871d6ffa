"""Files of poses: both forms, what is refused, and frames that a simulated camera took."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import boxwright
from boxwright.io.poses import write_poses
from boxwright.kinematics.transforms import quaternion_wxyz, turn_about_line
from boxwright.simulation import make_frame, make_looks
from boxwright.types import PosedCloud, PosedFile

IDENTITY = "[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"
GOOD = f'[[frame]]\nfile = "a.pcd"\nbase_from_camera = {IDENTITY}\n'


def _with(pose: str, file: str = "a.pcd") -> str:
    return f'[[frame]]\nfile = "{file}"\nbase_from_camera = {pose}\n'


BAD = (
    ("", "holds no frame"),
    ("frame = []", "holds no frame"),
    ("[[frame", "Expected ']]'"),
    ("[[frames]]\nfile = 'a.pcd'", "'frames' is not known"),
    ('[[frame]]\nfile = "a.pcd"', "frame 1: base_from_camera is missing"),
    (f"[[frame]]\nbase_from_camera = {IDENTITY}", "frame 1: file is missing"),
    (_with(IDENTITY, "gone.pcd"), "frame 1: gone.pcd: there is no such file; files are told from the folder of"),
    (GOOD + _with(IDENTITY, "../poses/a.pcd"), "frame 2: a.pcd is frame 1 already"),
    (GOOD.replace("base_from_camera", "camera_from_base"), "base_from_camera, its inverse"),
    (GOOD.replace("base_from_camera", "tool_from_camera"), "told in one fixed frame: base_from_camera"),
    (GOOD + "unit = 'mm'", "'unit' is not known"),
    (_with("[[1, 0, 0, 812.4], [0, 1, 0, 0], [0, 0, 1, 450], [0, 0, 0, 1]]"), "metres, not millimetres"),
    (_with("[[1, 0, 0, 0], [0, 1, 0.01, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"), "is no rigid motion"),
    (_with("[[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"), "is a mirror image"),
    (_with("[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.3, 0.2, 0.1, 1]]"), "last row"),
    (_with("[[1, 0, 0, nan], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"), "must be finite"),
    (_with("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]"), "must be 4 rows of 4 numbers, metres, or {position_m"),
    (_with("{position_m = [0, 0, 0]}"), "has the keys position_m"),
    (_with("{position_m = [0, 0], orientation_xyzw = [0, 0, 0, 1]}"), "position_m is [0, 0]; must be 3 numbers"),
    (_with("{position_m = [0, 0, 0], orientation_xyzw = [0, 0, 0, 2]}"), "must be a unit quaternion x, y, z, w"),
)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with two files that stand for clouds; nobody reads them here."""
    folder = tmp_path / "poses"
    folder.mkdir()
    for name in ("a.pcd", "b.pcd"):
        (folder / name).write_text("")
    return folder


def test_matrices_and_quaternions_tell_the_same(folder: Path) -> None:
    turn = turn_about_line((0.2, -0.1, 0.4), (1.0, 2.0, -0.5), 1.1)
    w, x, y, z = (round(value, 5) for value in quaternion_wxyz(turn))
    rows = [[round(float(value), 5) for value in row] for row in turn]
    position = [row[3] for row in rows[:3]]
    text = _with(str(rows)) + _with(f"{{position_m = {position}, orientation_xyzw = {[x, y, z, w]}}}", "b.pcd")
    (folder / "looks.toml").write_text(text)
    first, second = boxwright.read_poses(folder / "looks.toml")
    assert [first.file, second.file] == [folder / "a.pcd", folder / "b.pcd"]
    assert np.abs(first.base_from_camera - turn).max() < 2e-5
    assert np.abs(second.base_from_camera - turn).max() < 2e-5


def test_what_is_written_is_read(folder: Path) -> None:
    poses = [turn_about_line((0.1, 0.2, k), (k, 1.0, 0.3), 0.7 * k) for k in (1.0, 2.0)]
    frames = [PosedFile(file=Path(name), base_from_camera=pose) for name, pose in zip("ab", poses, strict=True)]
    named = [
        PosedFile(file=frame.file.with_suffix(".pcd"), base_from_camera=frame.base_from_camera) for frame in frames
    ]
    write_poses(folder / "looks.toml", named)
    for read, pose in zip(boxwright.read_poses(folder / "looks.toml"), poses, strict=True):
        assert np.abs(read.base_from_camera - pose).max() < 1e-12


def test_bad_files_name_file_frame_and_fault(folder: Path) -> None:
    path = folder / "looks.toml"
    for text, fault in BAD:
        path.write_text(text)
        with pytest.raises(ValueError, match=r"looks\.toml: ") as refusal:
            boxwright.read_poses(path)
        line = str(refusal.value)
        assert line.startswith(str(path)), line
        assert fault in line, line
        assert "\n" not in line, line
    assert len(BAD) == 20


def test_python_refuses_poses_that_are_none() -> None:
    cloud = boxwright.Cloud(points=np.zeros((4, 3), np.float32), width=2, height=2)
    for pose, fault in ((np.eye(3), "shape"), (2.0 * np.eye(4), "last row"), (np.diag([1, 1, 2, 1.0]), "no rigid")):
        with pytest.raises(ValueError, match=fault):
            PosedCloud(cloud=cloud, base_from_camera=pose)
    with pytest.raises(ValueError, match="there is no frame"):
        boxwright.infer_frames([])


def test_looks_are_of_one_scene_and_the_first_is_its_frame() -> None:
    looks = make_looks("small", 9, 2, 3, boxes=1)
    frame = make_frame("small", 9, 2, boxes=1)
    assert looks[0].frame.points.tobytes() == frame.points.tobytes()
    assert looks[0].frame.labels.tobytes() == frame.labels.tobytes()
    checked = 0
    for look in looks[1:]:
        first_from_look = np.linalg.inv(looks[0].base_from_camera) @ look.base_from_camera
        for there, here in zip(look.frame.truth.parts, looks[0].frame.truth.parts, strict=True):
            moved = np.array(there.corners) @ first_from_look[:3, :3].T + first_from_look[:3, 3]
            assert np.abs(moved - np.array(here.corners)).max() < 1e-9
            checked += 1
        seen = sum(part.visible_px for part in look.frame.truth.parts)
        assert seen >= 0.4 * sum(part.visible_px for part in frame.truth.parts)
    assert checked >= 10
