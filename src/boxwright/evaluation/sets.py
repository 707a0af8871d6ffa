"""Scene sets: a folder of clouds, each with its truth and its labels (docs/formats.md)."""

from __future__ import annotations

from collections.abc import Iterator
from os import PathLike
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.io.clouds import SUFFIXES as CLOUD_SUFFIXES
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.types import Truth

TRUTH_SUFFIX = ".truth.json"
LABELS_SUFFIX = ".labels.npz"


class SetEntry(msgspec.Struct, frozen=True, kw_only=True):
    """The files of one labelled frame."""

    name: str
    cloud_path: Path
    truth_path: Path
    labels_path: Path


class LabelledFrame(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """A labelled frame without its cloud: `labels` (N,), for each point the index of its true part + 1, 0 for none."""

    name: str
    cloud_path: Path
    truth: Truth
    labels: NDArray[np.uint16]


def list_set(folder: str | PathLike[str]) -> tuple[SetEntry, ...]:
    """The frames of a set, in the order of their names; every cloud needs its truth and labels, and they it.

    Raises OSError when the folder cannot be read, ValueError naming the frame and the file that is missing.
    """
    files = sorted(path for path in Path(folder).iterdir() if path.is_file())
    truths = _by_name(files, (TRUTH_SUFFIX,))
    labels = _by_name(files, (LABELS_SUFFIX,))
    clouds = _by_name(files, CLOUD_SUFFIXES)
    for name in sorted({*truths, *labels, *clouds}):
        for found, suffix in ((clouds, CLOUD_SUFFIXES[0]), (truths, TRUTH_SUFFIX), (labels, LABELS_SUFFIX)):
            if name not in found:
                raise ValueError(f"{folder}: {name}: {name}{suffix} is missing; a frame is cloud, truth and labels")
    if not truths:
        raise ValueError(f"{folder}: no frame in it; a scene set holds NAME.pcd, NAME.truth.json and NAME.labels.npz")
    return tuple(
        SetEntry(name=name, cloud_path=clouds[name], truth_path=truths[name], labels_path=labels[name])
        for name in sorted(truths)
    )


def read_entry(entry: SetEntry) -> LabelledFrame:
    """Read a frame's truth and labels. Raises OSError, and ValueError naming the file when one does not fit."""
    truth, labels = load_truth(entry.truth_path), read_truth_labels(entry.labels_path)
    boxes = {box.index for box in truth.boxes}
    for part in truth.parts:
        if part.box not in boxes:
            raise ValueError(f"{entry.truth_path}: parts: {part.name} is of box {part.box}; boxes are {sorted(boxes)}")
    if labels.size and labels.max() > len(truth.parts):
        raise ValueError(f"{entry.labels_path}: labels go to {labels.max()}; the truth has {len(truth.parts)} parts")
    return LabelledFrame(name=entry.name, cloud_path=entry.cloud_path, truth=truth, labels=labels)


def read_set(folder: str | PathLike[str]) -> Iterator[LabelledFrame]:
    """The frames of a set one by one; what is missing is said before the first. Errors are those of the two above."""
    return map(read_entry, list_set(folder))


def _by_name(files: list[Path], suffixes: tuple[str, ...]) -> dict[str, Path]:
    """Files with one of these suffixes, by what stands before it; ValueError when two stand for one frame."""
    found: dict[str, Path] = {}
    for path in files:
        for suffix in suffixes:
            if path.name.lower().endswith(suffix):
                name = path.name[: -len(suffix)]
                if name in found:
                    raise ValueError(f"{path.parent}: {name}: has {found[name].name} and {path.name}; must be one")
                found[name] = path
    return found
