"""segments.json and the labels.npz beside it, in and out (docs/formats.md)."""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import NDArray

from boxwright.io.arrays import read_flat_array, write_flat_arrays
from boxwright.io.decoding import load_json, save_json
from boxwright.types import Segmentation


def load_segments(path: str | PathLike[str]) -> Segmentation:
    """Read a segments.json: metres, the input's frame. Keys of later versions are ignored.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no usable segments.
    """
    return load_json(path, Segmentation)


def save_segments(segmentation: Segmentation, path: str | PathLike[str]) -> None:
    """Write a segments.json; equal segments give equal bytes. Raises OSError when it cannot be written."""
    save_json(segmentation, path)


def read_segment_labels(path: str | PathLike[str]) -> NDArray[np.int32]:
    """The segment (N,) of each input point, -1 for none. Raises OSError and ValueError as `read_flat_array` does."""
    return read_flat_array(path, "segment", np.int32)


def write_segment_labels(labels: NDArray[np.int32], path: str | PathLike[str]) -> None:
    """Write a labels.npz; equal labels give equal bytes. Raises OSError when it cannot be written."""
    write_flat_arrays(path, {"segment": labels})
