"""Answers as files (docs/formats.md): a model's with labels and exports of each object with a pose, segments'."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from boxwright.fusion import Fused
from boxwright.io.labels import PointLabels, write_labels
from boxwright.io.models import save_model
from boxwright.io.segments import save_segments, write_segment_labels
from boxwright.kinematics import save_mjcf, save_sdf, save_urdf
from boxwright.pipeline import Inferred
from boxwright.segmentation import Segmented
from boxwright.types import Object

PNG_COLOR_TYPE_AT, PNG_RGBA = 25, 6
"""Where a PNG's head says what its pixels are, and what it says of colours with opacity, as figures have them."""

WRITERS: dict[str, Callable[[Object, Path], None]] = {"urdf": save_urdf, "mjcf": save_mjcf, "sdf": save_sdf}
"""What an object is exported as, by the suffix of its file."""


def save_answer(inferred: Inferred, folder: Path, name: str, formats: Sequence[str] = ("urdf",)) -> tuple[Path, ...]:
    """Writes an answer to a folder, which is made where it is missing; the files written, model.json first.

    `name` names the exports: NAME_K.urdf for object K, likewise .mjcf and .sdf where `formats` has them. An object
    without a pose has none; the model's warnings say so. Exports, labels and the figure NAME.png of an earlier answer
    in that folder are removed, since their objects may be gone.

    Raises OSError when something cannot be written, KeyError for a format that WRITERS does not have.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _remove_earlier(folder, name)
    model, labels = folder / "model.json", folder / "labels.npz"
    save_model(inferred.model, model)
    write_labels(PointLabels(object=inferred.object_labels, part=inferred.part_labels), labels)
    return (model, labels, *_save_exports(inferred.model.objects, folder, name, formats))


def save_fused(fused: Fused, folder: Path, name: str, formats: Sequence[str] = ("urdf",)) -> tuple[Path, ...]:
    """Writes the answer to several frames as `save_answer` does; labels_K.npz are those of frame K, counted from 1.

    Raises OSError when something cannot be written, KeyError for a format that WRITERS does not have.
    """
    folder.mkdir(parents=True, exist_ok=True)
    _remove_earlier(folder, name)
    model = folder / "model.json"
    save_model(fused.model, model)
    labels = [folder / f"labels_{number}.npz" for number in range(1, len(fused.labels) + 1)]
    for path, of_frame in zip(labels, fused.labels, strict=True):
        write_labels(of_frame, path)
    return (model, *labels, *_save_exports(fused.model.objects, folder, name, formats))


def save_segmentation(segmented: Segmented, folder: Path) -> tuple[Path, ...]:
    """Writes segments.json and labels.npz to a folder, which is made where it is missing; the files written.

    Raises OSError when something cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    segments, labels = folder / "segments.json", folder / "labels.npz"
    save_segments(segmented.segmentation, segments)
    write_segment_labels(segmented.perception.labels, labels)
    return segments, labels


def _save_exports(objects: Sequence[Object], folder: Path, name: str, formats: Sequence[str]) -> list[Path]:
    exports = []
    for k, found in enumerate(objects):
        for suffix in formats if found.pose is not None else ():
            exports.append(folder / f"{name}_{k}.{suffix}")
            WRITERS[suffix](found, exports[-1])
    return exports


def _remove_earlier(folder: Path, name: str) -> None:
    """Removes what only some answers have, or have another number of; the input may be NAME.png in the same folder."""
    for path in folder.iterdir():
        is_export = path.suffix[1:] in WRITERS and _is_numbered(path.stem, name)
        is_labels = path.suffix == ".npz" and (path.stem == "labels" or _is_numbered(path.stem, "labels"))
        if is_export or is_labels or (path.name == f"{name}.png" and _is_figure(path)):
            path.unlink()


def _is_numbered(stem: str, name: str) -> bool:
    number = stem.removeprefix(f"{name}_")
    return stem == f"{name}_{number}" and number.isdecimal()


def _is_figure(path: Path) -> bool:
    """Figures are in colour; a depth image has one channel."""
    if not path.is_file():
        return False
    with path.open("rb") as stream:
        head = stream.read(PNG_COLOR_TYPE_AT + 1)
    return len(head) > PNG_COLOR_TYPE_AT and head[PNG_COLOR_TYPE_AT] == PNG_RGBA
