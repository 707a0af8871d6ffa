"""labels.npz beside a model.json: which object and which of its parts each input point belongs to (docs/formats.md)."""

from __future__ import annotations

from os import PathLike

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.io.arrays import read_flat_array, write_flat_arrays

NO_LABEL = -1
"""A point that belongs to no object, or to no part."""


class PointLabels(msgspec.Struct, frozen=True, eq=False):
    """For each input point, in input order (organized: v * width + u), invalid points included; -1 is none.

    `object` indexes the model's objects, `part` that object's parts. Both (N,) int16.
    Raises ValueError when they do not fit each other.
    """

    object: NDArray[np.int16]
    part: NDArray[np.int16]

    def __post_init__(self) -> None:
        for name, array in (("object", self.object), ("part", self.part)):
            if array.dtype != np.int16 or array.ndim != 1:
                raise ValueError(f"labels: {name}: is {array.dtype} of shape {array.shape}; must be int16, (N,)")
            if array.size and array.min() < NO_LABEL:
                raise ValueError(f"labels: {name}: holds {array.min()}; must be {NO_LABEL} (none) or more")
        if len(self.object) != len(self.part):
            raise ValueError(f"labels: object has {len(self.object)} entries, part {len(self.part)}; must be as many")
        if np.any((self.part != NO_LABEL) & (self.object == NO_LABEL)):
            raise ValueError("labels: part: names a part where object names none; a part belongs to an object")


def read_labels(path: str | PathLike[str]) -> PointLabels:
    """Read a labels.npz. Raises OSError when it cannot be read, ValueError naming file and array when it is wrong."""
    arrays = {name: read_flat_array(path, name, np.int16) for name in ("object", "part")}
    try:
        return PointLabels(**arrays)
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None


def write_labels(labels: PointLabels, path: str | PathLike[str]) -> None:
    """Write a labels.npz; equal labels give equal bytes. Raises OSError when it cannot be written."""
    write_flat_arrays(path, {"object": labels.object, "part": labels.part})
