"""Answers as files (docs/formats.md): a model's with labels and a URDF for each object with a pose, segments'."""

from __future__ import annotations

from pathlib import Path

from boxwright.io.labels import PointLabels, write_labels
from boxwright.io.models import save_model
from boxwright.io.segments import save_segments, write_segment_labels
from boxwright.kinematics import save_urdf
from boxwright.pipeline import Inferred
from boxwright.segmentation import Segmented


def save_answer(inferred: Inferred, folder: Path, name: str) -> tuple[Path, ...]:
    """Writes an answer to a folder, which is made where it is missing; the files written, model.json first.

    `name` names the URDFs: NAME_K.urdf for object K. An object without a pose has none; the model's warnings say so.
    URDFs of an earlier answer to the same input are removed, since their objects may be gone.

    Raises OSError when something cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    model, labels = folder / "model.json", folder / "labels.npz"
    save_model(inferred.model, model)
    write_labels(PointLabels(object=inferred.object_labels, part=inferred.part_labels), labels)
    _remove_urdfs(folder, name)
    urdfs = []
    for k, found in enumerate(inferred.model.objects):
        if found.pose is not None:
            urdfs.append(folder / f"{name}_{k}.urdf")
            save_urdf(found, urdfs[-1])
    return (model, labels, *urdfs)


def save_segmentation(segmented: Segmented, folder: Path) -> tuple[Path, ...]:
    """Writes segments.json and labels.npz to a folder, which is made where it is missing; the files written.

    Raises OSError when something cannot be written.
    """
    folder.mkdir(parents=True, exist_ok=True)
    segments, labels = folder / "segments.json", folder / "labels.npz"
    save_segments(segmented.segmentation, segments)
    write_segment_labels(segmented.perception.labels, labels)
    return segments, labels


def _remove_urdfs(folder: Path, name: str) -> None:
    for path in folder.iterdir():
        number = path.name.removeprefix(f"{name}_").removesuffix(".urdf")
        if path.name == f"{name}_{number}.urdf" and number.isdecimal():
            path.unlink()
