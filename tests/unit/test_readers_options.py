"""What a user says about a file: unit, frame, viewpoint, intrinsics; and the messages when it does not fit."""

import json
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from boxwright.io.clouds import read_cloud, write_pcd, write_ply
from boxwright.io.intrinsics import read_intrinsics
from boxwright.types import Intrinsics

WIDTH, HEIGHT = 8, 6
CAMERA = {"fx": 10.0, "fy": 11.0, "cx": 3.5, "cy": 2.5}
DEPTH_MM = (900 + np.arange(WIDTH * HEIGHT)).reshape(HEIGHT, WIDTH).astype(np.uint16)

YAML_FILE = """
image_width: 8
image_height: 6
camera_name: depth
camera_matrix: {rows: 3, cols: 3, data: [10, 0, 3.5, 0, 11, 2.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.1, -0.2, 0.001, 0.002, 0.05]}
"""
YAML_MESSAGE = """
header: {frame_id: depth}
height: 6
width: 8
distortion_model: rational_polynomial
D: [0.1, -0.2, 0.001, 0.002, 0.05, 0, 0, 0]
K: [10, 0, 3.5, 0, 11, 2.5, 0, 0, 1]
"""


def points() -> np.ndarray:
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    return np.stack([u * 0.1, v * 0.1, 1 + u * 0.01], axis=-1).reshape(-1, 3).astype(np.float32)


def write_depth(path: Path) -> Path:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in DEPTH_MM)
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0)
    parts = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + parts)
    return path


def test_written_clouds_are_read_back(tmp_path: Path) -> None:
    colors = np.arange(3 * WIDTH * HEIGHT, dtype=np.uint8).reshape(-1, 3)
    labels = np.arange(WIDTH * HEIGHT)
    write_pcd(
        tmp_path / "a.pcd", points(), width=WIDTH, height=HEIGHT, colors=colors, labels=labels, viewpoint=(0, 1, 2)
    )
    write_ply(tmp_path / "a.ply", points(), colors=colors, labels=labels)
    np.save(tmp_path / "a.npy", points().reshape(HEIGHT, WIDTH, 3))
    for name in ("a.pcd", "a.ply", "a.npy"):
        cloud = read_cloud(tmp_path / name)
        np.testing.assert_array_equal(cloud.points, points())
        assert not cloud.points.flags.writeable
        assert cloud.points.flags.c_contiguous
        if name != "a.npy":
            np.testing.assert_array_equal(cloud.colors, colors)
            np.testing.assert_array_equal(cloud.labels, labels)
        assert cloud.organized == (name != "a.ply")
    assert read_cloud(tmp_path / "a.pcd").viewpoint == (0.0, 1.0, 2.0)
    assert read_cloud(tmp_path / "a.ply", viewpoint=(1, 2, 3)).viewpoint == (1.0, 2.0, 3.0)


def test_unit_and_frame(tmp_path: Path) -> None:
    write_pcd(tmp_path / "mm.pcd", points() * 1000, width=WIDTH, height=HEIGHT)
    write_pcd(tmp_path / "gl.pcd", points() * [1, -1, -1], width=WIDTH, height=HEIGHT)
    with pytest.raises(ValueError, match=r"mm\.pcd: .*--unit mm"):
        read_cloud(tmp_path / "mm.pcd")
    with pytest.raises(ValueError, match=r"gl\.pcd: .*--frame opengl"):
        read_cloud(tmp_path / "gl.pcd")
    np.testing.assert_allclose(read_cloud(tmp_path / "mm.pcd", unit="mm").points, points(), rtol=1e-6)
    np.testing.assert_array_equal(
        read_cloud(tmp_path / "gl.pcd", frame="opengl").points, points() * np.float32([1, -1, -1])
    )


def test_depth_image_with_every_kind_of_intrinsics(tmp_path: Path) -> None:
    image = write_depth(tmp_path / "d.png")
    (tmp_path / "c.json").write_text(json.dumps(CAMERA | {"width": 8, "height": 6, "depth_unit_m": 0.001, "more": 1}))
    (tmp_path / "c.txt").write_text("# Depth camera intrinsic matrix\n10 0 3.5\n0 11 2.5\n0 0 1\n")
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    z = DEPTH_MM * 0.001
    wanted = np.stack([(u - 3.5) / 10 * z, (v - 2.5) / 11 * z, z], axis=-1).reshape(-1, 3)
    sources = [
        {"intrinsics": tmp_path / "c.json"},
        {"intrinsics": tmp_path / "c.txt", "depth_unit_m": 0.001},
        {"intrinsics": Intrinsics(**CAMERA, depth_unit_m=0.5), "depth_unit_m": 0.001},
    ]
    for options in sources:
        cloud = read_cloud(image, **options)
        assert (cloud.width, cloud.height, cloud.viewpoint) == (WIDTH, HEIGHT, (0.0, 0.0, 0.0))
        np.testing.assert_allclose(cloud.points, wanted, atol=1e-6)


@pytest.mark.parametrize("text", [YAML_FILE, YAML_MESSAGE])
def test_ros_camera_info(tmp_path: Path, text: str) -> None:
    (tmp_path / "info.yaml").write_text(text)
    wanted = Intrinsics(**CAMERA, width=8, height=6, distortion=(0.1, -0.2, 0.001, 0.002, 0.05))
    assert read_intrinsics(tmp_path / "info.yaml") == wanted
    with pytest.raises(ValueError, match="--depth-unit"):
        read_cloud(write_depth(tmp_path / "d.png"), intrinsics=tmp_path / "info.yaml")
    bent = read_cloud(tmp_path / "d.png", intrinsics=tmp_path / "info.yaml", depth_unit_m=0.001)
    straight = read_cloud(tmp_path / "d.png", intrinsics=Intrinsics(**CAMERA), depth_unit_m=0.001)
    assert 1e-4 < np.abs(bent.points - straight.points).max() < 0.1


REFUSALS: list[tuple[str, str, dict[str, object]]] = [
    ("d.png", "say --intrinsics FILE", {}),
    ("d.png", "the intrinsics are for 640 x 480", {"intrinsics": "vga"}),
    ("d.png", "--unit is for clouds", {"intrinsics": "here", "unit": "mm"}),
    ("d.png", "is depth_unit_m", {"intrinsics": "here", "depth_unit_m": 1.0}),
    ("d.png", 'depth_decode: is "rot"; must be one of: none rotate3', {"intrinsics": "here", "depth_decode": "rot"}),
    ("a.pcd", "--intrinsics, --depth-unit-m is for depth images", {"intrinsics": "here", "depth_unit_m": 1.0}),
    ("a.pcd", "--depth-decode is for depth images", {"depth_decode": "rotate3"}),
    ("a.pcd", 'unit: is "cm"; must be one of: m mm', {"unit": "cm"}),
    ("a.pcd", "viewpoint: has 2 values", {"viewpoint": (1, 2)}),
    ("a.pcd", "viewpoint holds nan; it must be finite", {"viewpoint": (0, 0, np.nan)}),
    ("a.stl", "the suffix '.stl' is no cloud's", {}),
    ("b.ply", "it begins with", {}),
]


@pytest.mark.parametrize(("name", "message", "options"), REFUSALS)
def test_what_does_not_fit_is_named(tmp_path: Path, name: str, message: str, options: dict[str, object]) -> None:
    write_depth(tmp_path / "d.png")
    write_pcd(tmp_path / "a.pcd", points(), width=WIDTH, height=HEIGHT)
    write_pcd(tmp_path / "b.ply", points(), width=WIDTH, height=HEIGHT)
    cameras = {"vga": {"width": 640, "height": 480}, "here": {}}
    if "intrinsics" in options:
        size = cameras[str(options["intrinsics"])]
        options = {"depth_unit_m": 0.001} | options | {"intrinsics": Intrinsics(**CAMERA, **size)}
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is checked below, quotes and all
        read_cloud(tmp_path / name, **options)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("c.json", '{"fx": 1, "fy": 1, "cx": 1}', "cy"),
        ("c.json", '{"fx": "wide", "fy": 1, "cx": 1, "cy": 1}', "fx"),
        ("c.json", '{"fx": 1, "fy": 1, "cx": 1, "cy": 1, "width": 3}', "width and height"),
        ("c.json", "{", "truncated"),
        ("c.yaml", "camera_matrix: {data: [1]}\nimage_width: 2\nimage_height: 2", "has 1 values; must be 9"),
        ("c.yaml", "a: [1", "is no YAML"),
        ("c.yaml", YAML_FILE.replace("plumb_bob", "equidistant"), "'equidistant' with 5 coefficients"),
        ("c.txt", "1 2 3", "there is no line"),
        ("c.toml", "fx = 1", "cannot be read from '.toml'"),
    ],
)
def test_intrinsics_that_do_not_fit(tmp_path: Path, name: str, content: str, message: str) -> None:
    (tmp_path / name).write_text(content)
    with pytest.raises(ValueError) as caught:  # noqa: PT011 - the text is checked below, quotes and all
        read_intrinsics(tmp_path / name)
    assert message in str(caught.value)
    assert str(caught.value).startswith(str(tmp_path / name))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("read", [read_cloud, read_intrinsics])
def test_a_missing_file_is_an_os_error(tmp_path: Path, read: Callable[[Path], object]) -> None:
    name = "none.json" if read is read_intrinsics else "none.pcd"
    with pytest.raises(FileNotFoundError) as caught:
        read(tmp_path / name)
    assert caught.value.filename == str(tmp_path / name)
