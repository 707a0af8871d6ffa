"""Frames of real sensors: what is read, and what is (not) found there."""

from __future__ import annotations

from pathlib import Path

import pytest

from boxwright import models
from boxwright.io.models import load_model
from support.command import boxwright

NO_BOX = (
    "box_on_floor_luxonis/calibration_camframe.pcd",
    "box_on_floor_luxonis/example_1_camframe.pcd",
    "box_on_floor_luxonis/example_1_opengl_frame.ply",
    "boxes_on_table_osd/learn0.pcd",
    "boxes_on_table_osd/learn0_binary_compressed.pcd",
    "boxes_on_table_osd/learn12.pcd",
    "milk_carton_pcl/milk_cartoon_all_small_clorox.pcd",
    "table_ros_industrial/table.pcd",
)
"""Closed cartons, a bare floor, bottles."""

TOTE = "tote_apc/tote_fused_model.pcd"
SHELF = "tote_apc/shelf_bin_frame00.pcd"
SHELF_DEPTH = "tote_apc/frame-000000.depth.png"

shipped_weights = pytest.mark.skipif(
    not (Path(models.__file__).parent / "weights/grid/carton.json").is_file(),
    reason="no learned weights are shipped yet",
)


@pytest.fixture(scope="module")
def real(shared_dir: Path) -> Path:
    return shared_dir / "data/real"


def test_every_file_is_read(real: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    paths = sorted(path for path in real.rglob("*") if path.suffix in (".pcd", ".ply"))
    assert {str(path.relative_to(real)) for path in paths} >= {*NO_BOX, TOTE, SHELF}
    answer = boxwright("infer", *paths, "-o", tmp_path, *carton, "--figure")
    assert answer.status == 0, answer.err
    for path in paths:
        assert (tmp_path / path.stem / "model.json").is_file()
        assert (tmp_path / path.stem / f"{path.stem}.png").is_file()


def test_a_depth_image_is_the_cloud_it_was_published_as(real: Path, carton: tuple[str, ...], tmp_path: Path) -> None:
    camera = ("--intrinsics", real / "tote_apc/cam.info.txt", "--depth-decode", "rotate3")
    depth = real / SHELF_DEPTH
    without_unit = boxwright("infer", depth, "-o", tmp_path, *carton, *camera)
    assert without_unit.status == 1
    assert "--depth-unit-m" in without_unit.err
    answer = boxwright("infer", depth, "-o", tmp_path, *carton, *camera, "--depth-unit-m", "0.0001")
    assert answer.status == 0, answer.err
    assert load_model(tmp_path / "frame-000000.depth/model.json").source.points == 640 * 480


@shipped_weights
@pytest.mark.parametrize("name", NO_BOX)
def test_no_open_box_where_there_is_none(real: Path, name: str, tmp_path: Path) -> None:
    assert boxwright("infer", real / name, "-o", tmp_path).status == 0
    assert load_model(tmp_path / Path(name).stem / "model.json").objects == ()


@shipped_weights
def test_the_tote_is_a_base_with_four_sides(real: Path, tmp_path: Path) -> None:
    assert boxwright("infer", real / TOTE, "-o", tmp_path).status == 0
    (found,) = load_model(tmp_path / "tote_fused_model/model.json").objects
    observed = {part.name for part in found.parts if part.observed}
    assert observed >= {"base", "side_0", "side_1", "side_2", "side_3"}
