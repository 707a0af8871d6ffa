"""Write the seed files of the fuzz targets, from our own writers and numpy: `python core/fuzz/make_seeds.py`."""

import io
import struct
import zlib
from pathlib import Path

import numpy as np

from boxwright.io.clouds import write_pcd, write_ply

SEEDS = Path(__file__).parent / "seeds"
WIDTH, HEIGHT = 4, 3
COUNT = WIDTH * HEIGHT


def points() -> np.ndarray:
    v, u = np.mgrid[0:HEIGHT, 0:WIDTH]
    xyz = np.stack([u * 0.1, v * 0.1, 1 + u * v * 0.05], axis=-1).reshape(COUNT, 3).astype(np.float32)
    xyz[5] = np.nan
    return xyz


def pcd_text() -> bytes:
    rows = "".join(f"{x} {y} {z} {k} {k * 0.5}\n" for k, (x, y, z) in enumerate(points()))
    return (
        "# comment\r\nVERSION .5\nFIELDS x y z label normal\nSIZE 4 4 8 2 4\nTYPE F F F I F\n"
        f"WIDTH {WIDTH}\nHEIGHT {HEIGHT}\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {COUNT}\nDATA ascii\n{rows}"
    ).encode()


def pcd_compressed() -> bytes:
    """Arrays of one value, as a literal of 4 bytes and matches: 3 x 48 bytes."""
    block = b"".join(
        b"\x03" + struct.pack("<f", value) + b"\xe0" + bytes([COUNT * 4 - 4 - 9, 3]) for value in (1, 2, 3)
    )
    header = f"FIELDS x y z _\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 4\nPOINTS {COUNT}\nDATA binary_compressed\n"
    return header.encode() + struct.pack("<II", len(block), COUNT * 12) + block


def ply_text() -> bytes:
    rows = "".join(f"{x} {y} {z} 2 7 8 255\n" for x, y, z in points())
    return (
        "ply\nformat ascii 1.0\ncomment c\nelement face 1\nproperty list uchar int vertex_indices\n"
        f"element vertex {COUNT}\nproperty double x\nproperty float y\nproperty float z\n"
        f"property list uchar int marks\nproperty uchar red\nend_header\n3 0 1 2\n{rows}"
    ).encode()


def ply_big_endian() -> bytes:
    header = (
        "ply\nformat binary_big_endian 1.0\nelement face 2\nproperty list uchar short vertex_indices\n"
        f"element vertex {COUNT}\nproperty list ushort uchar marks\nproperty double x\nproperty float y\n"
        "property float z\nproperty ushort red\nproperty ushort green\nproperty ushort blue\nend_header\n"
    )
    faces = struct.pack(">BhhB", 2, 1, 2, 0)
    return header.encode() + faces + b"".join(struct.pack(">HBBdffHHH", 2, 3, 4, *xyz, 1, 2, 3) for xyz in points())


def npy(array: np.ndarray) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


def png() -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    depth = (1000 + np.arange(COUNT) * 7).astype(">u2").reshape(HEIGHT, WIDTH)
    rows = b"".join(b"\0" + row.tobytes() for row in depth)
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 16, 0, 0, 0, 0)
    parts = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    return b"\x89PNG\r\n\x1a\n" + parts


def main() -> None:
    for target in ("pcd", "ply", "npy", "depth_png"):
        (SEEDS / target).mkdir(parents=True, exist_ok=True)
    colors = np.arange(COUNT * 3, dtype=np.uint8).reshape(COUNT, 3)
    labels = np.arange(COUNT)
    write_pcd(SEEDS / "pcd" / "binary.pcd", points(), width=WIDTH, height=HEIGHT, colors=colors, labels=labels)
    write_ply(SEEDS / "ply" / "binary.ply", points(), colors=colors, labels=labels)
    image = points().reshape(HEIGHT, WIDTH, 3)
    contents = {
        "pcd/text.pcd": pcd_text(),
        "pcd/compressed.pcd": pcd_compressed(),
        "ply/text.ply": ply_text(),
        "ply/big_endian.ply": ply_big_endian(),
        "npy/list.npy": npy(points()),
        "npy/image.npy": npy(np.asfortranarray(image)),
        "npy/big_endian.npy": npy(image.astype(">f8")),
        "depth_png/depth.png": png(),
    }
    for name, content in contents.items():
        (SEEDS / name).write_bytes(content)


if __name__ == "__main__":
    main()
