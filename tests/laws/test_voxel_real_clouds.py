"""The voxel front end on real clouds without an image grid agrees with the paper's chain about the ground."""

from pathlib import Path

import numpy as np
import pytest

from boxwright.io.clouds import read_cloud
from boxwright.perception import perceive
from boxwright.types import Cloud

CLOUDS = (
    "tote_apc/tote_fused_model.pcd",
    "table_ros_industrial/table.pcd",
    "box_on_floor_luxonis/calibration_camframe.pcd",
    "box_on_floor_luxonis/example_1_camframe.pcd",
    "boxes_on_table_osd/learn0.pcd",
    "milk_carton_pcl/milk_cartoon_all_small_clorox.pcd",
)


def without_grid(cloud: Cloud) -> Cloud:
    """The readings alone, with the viewpoint."""
    points = np.ascontiguousarray(cloud.points[np.isfinite(cloud.points).all(axis=1)])
    return Cloud(points=points, width=len(points), height=1, viewpoint=cloud.viewpoint)


def test_both_front_ends_see_one_ground(shared_dir: Path) -> None:
    cases = 0
    for name in CLOUDS:
        cloud = without_grid(read_cloud(shared_dir / "data" / "real" / name))
        ours, paper = perceive(cloud, planes="grid"), perceive(cloud, planes="ransac")
        assert ours.up @ paper.up > np.cos(np.radians(2)), name
        assert (ours.support_plane is None) == (paper.support_plane is None), name
        if ours.support_plane and paper.support_plane:
            assert ours.support_plane[1] == pytest.approx(paper.support_plane[1], abs=0.01), name
            assert np.any(ours.groups == -1), name
        cases += 1
    assert cases == 6


def test_a_bare_floor_holds_no_thing(shared_dir: Path) -> None:
    floor = perceive(read_cloud(shared_dir / "data" / "real" / CLOUDS[2]), planes="grid")
    assert set(floor.groups) == {-1}
