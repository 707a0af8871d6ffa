"""Readers of the shared files in a few lines of numpy: the oracle for the real ones. They trust what they read."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def pcd_header(path: Path) -> tuple[dict[str, list[str]], bytes]:
    """Header entries by keyword, and the bytes after the DATA line."""
    content = path.read_bytes()
    start = content.index(b"\n", content.index(b"\nDATA ") + 1) + 1
    lines = [line.split() for line in content[:start].decode("ascii").splitlines() if not line.startswith("#")]
    return {line[0]: line[1:] for line in lines}, content[start:]


def record_type(header: dict[str, list[str]]) -> np.dtype:
    letters = {"F": "f", "U": "u", "I": "i"}
    fields = zip(header["FIELDS"], header["TYPE"], header["SIZE"], strict=True)
    return np.dtype([(name, f"<{letters[kind]}{size}") for name, kind, size in fields])


def binary_pcd(path: Path) -> tuple[dict[str, list[str]], NDArray[np.void]]:
    header, body = pcd_header(path)
    return header, np.frombuffer(body, record_type(header), int(header["POINTS"][0]))


def binary_ply(path: Path, kinds: dict[str, str]) -> NDArray[np.void]:
    """A little-endian PLY with vertices only; `kinds` are numpy's names of PLY's types."""
    header, body = path.read_bytes().split(b"end_header\n", 1)
    rows = [line.split() for line in header.decode("ascii").splitlines()]
    count = next(int(row[2]) for row in rows if row[:2] == ["element", "vertex"])
    return np.frombuffer(body, np.dtype([(row[2], kinds[row[1]]) for row in rows if row[0] == "property"]), count)


def xyz(rows: NDArray[np.void]) -> NDArray[np.float32]:
    return np.stack([rows[name].astype(np.float32) for name in "xyz"], axis=1)


def unpacked(bits: NDArray[np.uint32]) -> NDArray[np.uint8]:
    return np.stack([(bits >> shift & 255).astype(np.uint8) for shift in (16, 8, 0)], axis=1)
