"""`boxwright infer` on frames that are as they should be."""

from __future__ import annotations

import json
import xml.etree.ElementTree as ET
from pathlib import Path

import jsonschema
import numpy as np
from PIL import Image

from boxwright.io.clouds import read_cloud, write_pcd
from boxwright.io.labels import read_labels
from boxwright.io.models import load_model
from support.command import boxwright
from support.repository import REPOSITORY


def test_a_frame_becomes_a_folder_of_answers(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    answer = boxwright("infer", frame, "-o", tmp_path, *carton, "--figure", "--verbose")
    assert (answer.status, answer.err) == (0, "")
    folder = tmp_path / "small_0000"
    model = load_model(folder / "model.json")
    assert model.objects
    schema = json.loads((REPOSITORY / "docs/schemas/model.schema.json").read_text())
    jsonschema.validate(json.loads((folder / "model.json").read_text()), schema)

    labels = read_labels(folder / "labels.npz")
    assert len(labels.object) == model.source.points == 640 * 480
    for k, found in enumerate(model.objects):
        counts = np.bincount(labels.part[(labels.object == k) & (labels.part >= 0)], minlength=len(found.parts))
        assert counts.tolist() == [part.points for part in found.parts]

    posed = [k for k, found in enumerate(model.objects) if found.pose is not None]
    urdfs = {f"small_0000_{k}.urdf" for k in posed}
    assert {path.name for path in folder.iterdir()} == {"model.json", "labels.npz", "small_0000.png", *urdfs}
    assert (folder / "small_0000.png").read_bytes().startswith(b"\x89PNG")
    for joint in model.objects[0].joints:
        assert joint.name in answer.out
        assert f"{np.degrees(joint.position):.1f} deg" in answer.out


def test_same_input_same_bytes_on_one_thread_or_two(scene_set: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    clouds = sorted(scene_set.glob("*.pcd"))
    for jobs in ("1", "2"):
        answer = boxwright("infer", *clouds, "-o", tmp_path / jobs, *carton, "--jobs", jobs, "--figure")
        assert answer.status == 0
    compared = 0
    for path in sorted((tmp_path / "1").rglob("*")):
        other = tmp_path / "2" / path.relative_to(tmp_path / "1")
        if path.name == "model.json":
            assert _without_seconds(path) == _without_seconds(other)
        elif path.is_file():
            assert path.read_bytes() == other.read_bytes(), path.name
        compared += path.is_file()
    assert compared >= 9


def _without_seconds(path: Path) -> dict[str, object]:
    content: dict[str, object] = json.loads(path.read_text())
    del content["seconds"]
    return content


def test_json_tells_of_every_input(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    answer = boxwright("infer", frame, tmp_path / "gone.pcd", "-o", tmp_path, *carton, "--json")
    assert answer.status == 1
    good, bad = json.loads(answer.out)
    assert good["input"] == str(frame)
    assert good["objects"][0]["template"] == "carton"
    assert all(Path(path).is_file() for path in good["files"])
    assert "gone.pcd" in bad["error"]


def test_an_empty_room_is_an_answer(carton: tuple[str, ...], tmp_path: Path) -> None:
    v, u = np.mgrid[0:120, 0:160]
    down = 1.0 / ((v - 20.0) / 140.0 + 0.3)
    floor = np.stack([(u - 80.0) / 140.0 * down, (v - 60.0) / 140.0 * down, down], axis=-1)
    path = tmp_path / "floor.pcd"
    write_pcd(path, floor.reshape(-1, 3).astype(np.float32), width=160, height=120)
    answer = boxwright("infer", path, "-o", tmp_path / "out", *carton, "--figure")
    assert answer.status == 0, answer.err
    assert load_model(tmp_path / "out/floor/model.json").objects == ()
    assert "no objects" in answer.out
    assert (tmp_path / "out/floor/floor.png").is_file()


def test_a_region_leaves_out_what_is_beyond_it(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    low, high = 0.0, 4.0
    answer = boxwright("infer", frame, "-o", tmp_path, *carton, f"--roi=-5,{low},-5,5,0,{high}")
    assert answer.status == 0, answer.err
    labelled = read_labels(tmp_path / "small_0000/labels.npz").object >= 0
    points = read_cloud(frame).points
    assert not np.any(labelled & ~(points[:, 0] <= low))


def test_old_urdfs_go_when_their_objects_are_gone(frame: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    folder = tmp_path / "small_0000"
    folder.mkdir()
    (folder / "small_0000_17.urdf").write_text("old")
    (folder / "small_0000_17.mjcf").write_text("old")
    (folder / "mine.urdf").write_text("kept")
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    assert not (folder / "small_0000_17.urdf").exists()
    assert not (folder / "small_0000_17.mjcf").exists()
    assert (folder / "mine.urdf").exists()


def test_an_earlier_figure_and_labels_of_frames_go_where_the_answer_has_none(
    frame: Path, carton: tuple[str, ...], tmp_path: Path
) -> None:
    folder = tmp_path / "small_0000"
    assert boxwright("infer", frame, "-o", tmp_path, *carton, "--figure").status == 0
    (folder / "labels_1.npz").write_text("old")
    (folder / "labels_mine.npz").write_text("kept")
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    urdfs = {path.name for path in folder.glob("*.urdf")}
    assert {path.name for path in folder.iterdir()} == {"model.json", "labels.npz", "labels_mine.npz", *urdfs}


def test_a_depth_image_that_lies_where_its_figure_would_is_no_figure(
    frame: Path, carton: tuple[str, ...], tmp_path: Path
) -> None:
    folder = tmp_path / "small_0000"
    folder.mkdir()
    Image.fromarray(np.ones((4, 4), dtype=np.uint16)).save(folder / "small_0000.png")
    assert boxwright("infer", frame, "-o", tmp_path, *carton).status == 0
    assert (folder / "small_0000.png").exists()


def test_mjcf_and_sdf_are_written_where_they_are_asked_for(
    frame: Path, carton: tuple[str, ...], tmp_path: Path
) -> None:
    assert boxwright("infer", frame, "-o", tmp_path, *carton, "--mjcf", "--sdf").status == 0
    folder = tmp_path / "small_0000"
    posed = [k for k, found in enumerate(load_model(folder / "model.json").objects) if found.pose is not None]
    assert posed
    for k in posed:
        root = ET.parse(folder / f"small_0000_{k}.sdf").getroot()
        assert root.tag == "sdf"
        assert ET.parse(folder / f"small_0000_{k}.mjcf").getroot().tag == "mujoco"
