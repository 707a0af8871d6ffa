"""The truth beside a labelled frame: NAME.truth.json and NAME.labels.npz of a scene set (docs/formats.md)."""

from __future__ import annotations

from os import PathLike

import numpy as np
from numpy.typing import NDArray

from boxwright.io.arrays import read_flat_array, write_flat_arrays
from boxwright.io.decoding import load_json, save_json
from boxwright.types import Truth


def load_truth(path: str | PathLike[str]) -> Truth:
    """Read a truth.json: metres and degrees, input's frame; keys that are not known are ignored.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no truth.
    """
    return load_json(path, Truth)


def save_truth(truth: Truth, path: str | PathLike[str]) -> None:
    """Write a truth.json; equal truths give equal bytes. Raises OSError when it cannot be written."""
    save_json(truth, path)


def read_truth_labels(path: str | PathLike[str]) -> NDArray[np.uint16]:
    """Read the labels of a labelled frame: (N,), for each point the index of its true part + 1, 0 for none.

    The file may hold them as (N,) or as (height, width).

    Raises OSError when the file cannot be read, ValueError naming file and array when it does not fit.
    """
    return read_flat_array(path, "labels", np.uint16, image_allowed=True)


def read_truth_faces(path: str | PathLike[str]) -> NDArray[np.uint16]:
    """Read the faces of a labelled frame: (N,), for each point the number of the flat face that it lies on, 0 for none.

    Panels come first (their number is the label), then the faces that are no panels (docs/formats.md).

    Raises OSError when the file cannot be read, ValueError naming file and array when there is none or it does not fit.
    """
    return read_flat_array(path, "faces", np.uint16, image_allowed=True)


def write_truth_labels(
    labels: NDArray[np.uint16], path: str | PathLike[str], faces: NDArray[np.uint16] | None = None
) -> None:
    """Write the labels (N,) of a labelled frame, and the faces (N,) where they are known.

    Equal arrays give equal bytes. Raises OSError when the file cannot be written.
    """
    write_flat_arrays(path, {"labels": labels} if faces is None else {"labels": labels, "faces": faces})
