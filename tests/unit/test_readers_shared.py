"""Every shared file against the minimal readers: points, invalid readings, colours, labels, layout."""

from pathlib import Path

import numpy as np
import pytest

from boxwright.io.clouds import read_cloud
from support.minimal_readers import binary_pcd, binary_ply, unpacked, xyz

REAL_BINARY = 8
LABELLED = 14


def binary_pcds(shared_dir: Path) -> list[Path]:
    files = [*(shared_dir / "data" / "real").rglob("*.pcd"), *(shared_dir / "data" / "labelled").glob("*.pcd")]
    return sorted(path for path in files if "compressed" not in path.name)


def test_every_binary_pcd(shared_dir: Path) -> None:
    files = binary_pcds(shared_dir)
    for path in files:
        header, rows = binary_pcd(path)
        cloud = read_cloud(path)
        width, height = int(header["WIDTH"][0]), int(header["HEIGHT"][0])
        assert (cloud.width, cloud.height, cloud.organized) == (width, height, height > 1), path
        np.testing.assert_array_equal(cloud.points, xyz(rows), err_msg=str(path))
        assert (cloud.viewpoint == (0.0, 0.0, 0.0)) if cloud.organized else (cloud.viewpoint is None)
        assert (cloud.colors is None) == ("rgb" not in header["FIELDS"])
        if cloud.colors is not None:
            np.testing.assert_array_equal(cloud.colors, unpacked(rows["rgb"]))
        assert (cloud.labels is None) == ("label" not in header["FIELDS"])
        if cloud.labels is not None:
            np.testing.assert_array_equal(cloud.labels, rows["label"])
        assert cloud.path == str(path)
    assert len(files) == REAL_BINARY + LABELLED


def test_compressed_equals_uncompressed(shared_dir: Path) -> None:
    folder = shared_dir / "data" / "real" / "boxes_on_table_osd"
    compressed, plain = read_cloud(folder / "learn0_binary_compressed.pcd"), read_cloud(folder / "learn0.pcd")
    np.testing.assert_array_equal(compressed.points, plain.points)
    np.testing.assert_array_equal(compressed.colors, plain.colors)
    np.testing.assert_array_equal(compressed.labels, plain.labels)
    assert np.isnan(plain.points).any()


def test_double_ply(shared_dir: Path) -> None:
    path = shared_dir / "data" / "real" / "box_on_floor_luxonis" / "example_1_opengl_frame.ply"
    rows = binary_ply(path, {"double": "<f8", "uchar": "u1"})
    cloud = read_cloud(path)
    np.testing.assert_array_equal(cloud.points, xyz(rows))
    np.testing.assert_array_equal(cloud.colors, np.stack([rows[c] for c in ("red", "green", "blue")], axis=1))
    assert not cloud.organized
    assert cloud.viewpoint is None


def test_depth_image_equals_its_cloud(shared_dir: Path) -> None:
    folder = shared_dir / "data" / "real" / "tote_apc"
    image = read_cloud(
        folder / "frame-000000.depth.png",
        intrinsics=folder / "cam.info.txt",
        depth_unit_m=1e-4,
        depth_decode="rotate3",
    )
    _, rows = binary_pcd(folder / "shelf_bin_frame00.pcd")
    assert (image.width, image.height) == (640, 480)
    assert image.viewpoint == (0.0, 0.0, 0.0)
    np.testing.assert_allclose(image.points, xyz(rows), rtol=0, atol=1e-6, equal_nan=True)
    assert np.isfinite(image.points).all(axis=1).sum() > 80_000


@pytest.mark.parametrize(
    ("options", "mend"), [({"unit": "mm"}, "leave out --unit mm"), ({"frame": "opengl"}, "leave out --frame opengl")]
)
def test_a_real_frame_in_the_wrong_unit_or_frame(shared_dir: Path, options: dict[str, str], mend: str) -> None:
    with pytest.raises(ValueError, match=mend):
        read_cloud(shared_dir / "data" / "labelled" / "small_000.pcd", **options)
