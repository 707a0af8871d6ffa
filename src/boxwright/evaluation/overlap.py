"""How many points predicted and true panels share."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.types import Object, Truth

Counts = NDArray[np.int64]


class Overlap(msgspec.Struct, frozen=True, eq=False):
    """Counts of points. The last column of every table stands for true label 0, "on no panel"."""

    part_on_true: tuple[Counts, ...]
    """For each object (parts, true parts + 1): points of its part that lie on a true part."""
    object_on_true: Counts
    """(objects, true parts + 1), points that the object has without naming a part included."""
    readings: Counts
    """(true parts + 1): readings of each true part."""


def count_overlap(
    objects: tuple[Object, ...],
    object_labels: NDArray[np.integer],
    part_labels: NDArray[np.integer],
    truth: Truth,
    truth_labels: NDArray[np.integer],
) -> Overlap:
    """Count what predicted labels (docs/formats.md, `infer`) and true labels (scene sets) share; all are (N,).

    Raises ValueError when the labels are not as many as each other or name what is not there.
    """
    _check_labels(objects, object_labels, part_labels, truth, truth_labels)
    columns = len(truth.parts) + 1
    true_column = np.where(truth_labels == 0, columns, truth_labels).astype(np.int64) - 1
    tables = []
    for k, model_object in enumerate(objects):
        mine = np.flatnonzero(object_labels == k)
        rows = len(model_object.parts) + 1
        row = np.where(part_labels[mine] < 0, rows - 1, part_labels[mine]).astype(np.int64)
        tables.append(_table(row, true_column[mine], rows, columns))
    return Overlap(
        part_on_true=tuple(table[:-1] for table in tables),
        object_on_true=np.array([table.sum(axis=0) for table in tables], np.int64).reshape(len(objects), columns),
        readings=np.bincount(true_column, minlength=columns),
    )


def _table(rows: Counts, columns: Counts, row_count: int, column_count: int) -> Counts:
    flat = np.bincount(rows * column_count + columns, minlength=row_count * column_count)
    return flat.reshape(row_count, column_count)


def _check_labels(
    objects: tuple[Object, ...],
    object_labels: NDArray[np.integer],
    part_labels: NDArray[np.integer],
    truth: Truth,
    truth_labels: NDArray[np.integer],
) -> None:
    shapes = {"object": object_labels.shape, "part": part_labels.shape, "truth": truth_labels.shape}
    if len(set(shapes.values())) != 1 or object_labels.ndim != 1:
        raise ValueError(f"{truth.name}: labels have shapes {shapes}; each must be (N,), one entry for each point")
    if truth_labels.size and not 0 <= truth_labels.min() <= truth_labels.max() <= len(truth.parts):
        raise ValueError(f"{truth.name}: true labels go to {truth_labels.max()}; there are {len(truth.parts)} parts")
    if object_labels.size and object_labels.max() >= len(objects):
        raise ValueError(f"{truth.name}: object labels go to {object_labels.max()}; there are {len(objects)} objects")
    for k, model_object in enumerate(objects):
        highest = part_labels[object_labels == k].max(initial=-1)
        if highest >= len(model_object.parts):
            raise ValueError(
                f"{truth.name}: part labels of object {k} go to {highest}; it has {len(model_object.parts)} parts"
            )
