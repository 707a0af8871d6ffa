"""Flat arrays in .npz files, checked before anything is allocated."""

from __future__ import annotations

import math
import zipfile
import zlib
from os import PathLike
from typing import IO, TypeVar

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

Number = TypeVar("Number", bound=np.generic)

HEADER_READERS = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}


def read_flat_array(
    path: str | PathLike[str], name: str, dtype: type[Number], *, image_allowed: bool = False
) -> NDArray[Number]:
    """Read the array `name` of an .npz file as (N,); an image (height, width), where allowed, row by row.

    Raises OSError when the file cannot be read, ValueError naming file and array when it is no such array.
    """
    try:
        with zipfile.ZipFile(path) as archive, archive.open(f"{name}.npy") as member:
            return _read_member(member, archive.getinfo(f"{name}.npy").file_size, dtype, 2 if image_allowed else 1)
    except KeyError:
        raise ValueError(f"{path}: {name}: no array of that name; found {_array_names(path)}") from None
    except (ValueError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError, RuntimeError) as error:
        raise ValueError(f"{path}: {name}: {str(error).splitlines()[0]}") from error


def write_flat_arrays(path: str | PathLike[str], arrays: dict[str, NDArray[np.generic]]) -> None:
    """Write arrays as a compressed .npz file; equal arrays give equal bytes (numpy writes no time into it)."""
    with open(path, "wb") as file:
        np.savez_compressed(file, allow_pickle=False, **arrays)


def _read_member(member: IO[bytes], size_bytes: int, dtype: type[Number], max_axes: int) -> NDArray[Number]:
    """An array whose header does not claim more than the archive holds."""
    version = npy.read_magic(member)
    if version not in HEADER_READERS:
        raise ValueError(f"is written in .npy version {version}; must be 1.0 or 2.0")
    shape, by_columns, found = HEADER_READERS[version](member)
    if found != np.dtype(dtype) or not 1 <= len(shape) <= max_axes or (by_columns and len(shape) > 1):
        wanted = "(N,)" if max_axes == 1 else "(N,) or (height, width), row by row"
        raise ValueError(f"is {found} of shape {shape}; must be {np.dtype(dtype)}, {wanted}")
    wanted_bytes = math.prod(shape) * np.dtype(dtype).itemsize
    if wanted_bytes > size_bytes:
        raise ValueError(f"header claims {wanted_bytes} bytes of data; the file has at most {size_bytes}")
    data = member.read(wanted_bytes)
    if len(data) != wanted_bytes:
        raise ValueError(f"has {len(data)} of the {wanted_bytes} bytes its header claims; the file is truncated")
    return np.frombuffer(data, dtype=found).astype(dtype)


def _array_names(path: str | PathLike[str]) -> str:
    with zipfile.ZipFile(path) as archive:
        return ", ".join(name.removesuffix(".npy") for name in archive.namelist()) or "none"
