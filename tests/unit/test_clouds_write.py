"""The writers against the formats' own layout, read back with numpy alone."""

from pathlib import Path

import numpy as np
import pytest

from boxwright.io.clouds import write_pcd, write_ply
from boxwright.types.cloud import Cloud

POINTS = np.array([[0, 0, 1], [np.nan, np.nan, np.nan], [0.5, -0.25, 2], [1, 2, 3], [4, 5, 6], [7, 8, 9]], np.float32)
COLORS = np.arange(18, dtype=np.uint8).reshape(6, 3)
LABELS = np.array([0, 1, 20, 30, 65536, 2**32 - 1], np.uint32)


def test_pcd_layout(tmp_path: Path) -> None:
    path = tmp_path / "a.pcd"
    write_pcd(path, POINTS, width=3, height=2, colors=COLORS, labels=LABELS, viewpoint=(1, 2, 0.5))
    header, body = path.read_bytes().split(b"DATA binary\n")
    assert b"\nFIELDS x y z rgb label\nSIZE 4 4 4 4 4\nTYPE F F F U U\nCOUNT 1 1 1 1 1\nWIDTH 3\nHEIGHT 2\n" in header
    assert b"\nVIEWPOINT 1 2 0.5 1 0 0 0\nPOINTS 6\n" in header
    words = np.frombuffer(body, "<u4").reshape(6, 5)
    np.testing.assert_array_equal(words[:, :3].copy().view("<f4"), POINTS)
    np.testing.assert_array_equal(words[:, 3].copy().view(np.uint8).reshape(6, 4)[:, 2::-1], COLORS)
    np.testing.assert_array_equal(words[:, 4], LABELS)


def test_ply_layout(tmp_path: Path) -> None:
    path = tmp_path / "a.ply"
    write_ply(path, POINTS, colors=COLORS, labels=LABELS)
    header, body = path.read_bytes().split(b"end_header\n")
    assert header.startswith(b"ply\nformat binary_little_endian 1.0\nelement vertex 6\nproperty float x\n")
    rows = np.frombuffer(body, np.dtype([("xyz", "<f4", 3), ("rgb", "u1", 3), ("label", "<u4")]))
    np.testing.assert_array_equal(rows["xyz"], POINTS)
    np.testing.assert_array_equal(rows["rgb"], COLORS)
    np.testing.assert_array_equal(rows["label"], LABELS)


@pytest.mark.parametrize("bad", [{"colors": COLORS[:5]}, {"labels": LABELS[:5]}, {"labels": -np.ones(6, int)}])
def test_what_does_not_fit_is_named(tmp_path: Path, bad: dict[str, np.ndarray]) -> None:
    with pytest.raises(ValueError, match=next(iter(bad))):
        write_pcd(tmp_path / "a.pcd", POINTS, width=3, height=2, **bad)


def test_cloud_arrays_are_checked_and_read_only() -> None:
    points = POINTS.copy()
    cloud = Cloud(points=points, width=3, height=2, colors=COLORS)
    assert cloud.organized
    assert not Cloud(points=points, width=6, height=1).organized
    with pytest.raises(ValueError, match="read-only"):
        cloud.points[0, 0] = 1.0
    points[0, 0] = 1.0  # the caller's own array stays writable
    with pytest.raises(ValueError, match="points"):
        Cloud(points=points.astype(np.float64), width=3, height=2)
    with pytest.raises(ValueError, match="points"):
        Cloud(points=points, width=3, height=3)
