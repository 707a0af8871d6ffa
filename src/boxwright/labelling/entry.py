"""A filled form as an entry of a scene set: cloud, truth and labels (docs/formats.md, "Scene sets")."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation.roles import FLAP, TUCK, kind_of, to_truth_name
from boxwright.evaluation.sets import LABELS_SUFFIX, TRUTH_SUFFIX
from boxwright.io.clouds import write_pcd
from boxwright.io.truth import load_truth, save_truth, write_truth_labels
from boxwright.labelling.checks import SIDE, goes_clockwise, odd_pieces
from boxwright.labelling.form import Form
from boxwright.labelling.roles import Role, read_role
from boxwright.segmentation import vector
from boxwright.types import Cloud, Segment, Segmentation, TrueBox, TruePart, Truth
from boxwright.types.truth import Vector

PARENT_KIND = {FLAP: SIDE, TUCK: FLAP}
"""What a part hangs on, by kind: the part of the same number."""

VARIANT = "by hand"


@dataclass(frozen=True, eq=False)
class LabelledEntry:
    """A frame as a person labelled it: `labels` (N,), for each point the index of its part in the truth + 1, 0 none."""

    truth: Truth
    labels: NDArray[np.uint16]
    warnings: tuple[str, ...]


def labelled_entry(
    name: str,
    form: Form,
    segmentation: Segmentation,
    segment_of: NDArray[np.int32],
    template: _core.Template,
) -> LabelledEntry:
    """What a filled form says of a cloud whose points (N,) belong to the segments `segment_of`, -1 for none.

    Raises ValueError naming file and line of a role that is not known or not possible.
    """
    segments = segmentation.segments
    numbers_of = _numbers_of(form, template, len(segments))
    boxes = sorted({role.box for role in numbers_of})
    warnings, parts = [], []
    labels = np.zeros(len(segment_of), np.uint16)
    for role in sorted(numbers_of, key=lambda role: (role.box, template.parts.index(role.part))):
        numbers = numbers_of[role]
        pieces = [segments[k] for k in numbers]
        for k, how in odd_pieces(pieces):
            told = form.place(numbers[k])
            warnings.append(f"{told}: segment {numbers[k]} is {how} from the other pieces of {role.part}")
        mine = np.isin(segment_of, numbers)
        parts.append(_true_part(boxes.index(role.box), role.part, pieces, int(mine.sum()), template))
        labels[mine] = len(parts)
    for box in boxes:
        _refuse_clockwise(form, box, numbers_of, segmentation)
    truth = Truth(
        name=name,
        category=form.category,
        camera=None,
        up=segmentation.up,
        boxes=tuple(TrueBox(k, form.category, VARIANT, None) for k in range(len(boxes))),
        parts=tuple(parts),
    )
    return LabelledEntry(truth, labels, tuple(warnings))


def save_entry(folder: Path, cloud: Cloud, entry: LabelledEntry) -> tuple[Path, ...]:
    """Writes cloud, truth and labels of a labelled frame to a set; the files written.

    Raises ValueError rather than overwrite a truth that was measured or simulated, OSError when it cannot be written.
    """
    name = entry.truth.name
    pcd, truth, labels = folder / f"{name}.pcd", folder / f"{name}{TRUTH_SUFFIX}", folder / f"{name}{LABELS_SUFFIX}"
    if truth.exists() and load_truth(truth).camera is not None:
        raise ValueError(f"{truth}: is no person's labelling and would be lost; name another folder with -o")
    folder.mkdir(parents=True, exist_ok=True)
    write_pcd(pcd, cloud.points, width=cloud.width, height=cloud.height, colors=cloud.colors, viewpoint=cloud.viewpoint)
    save_truth(entry.truth, truth)
    write_truth_labels(entry.labels, labels)
    return pcd, truth, labels


def _numbers_of(form: Form, template: _core.Template, count: int) -> dict[Role, list[int]]:
    """The segments of each role, in the order of their numbers."""
    found: dict[Role, list[int]] = {}
    for number, text in sorted(form.roles.items()):
        if number >= count:
            raise ValueError(f"{form.place(number)}: there is no segment {number}; they go to {count - 1}")
        try:
            role = read_role(text, template)
        except ValueError as error:
            raise ValueError(f"{form.place(number)}: {error}") from None
        if role is not None:
            found.setdefault(role, []).append(number)
    return found


def _true_part(box: int, part: str, pieces: Sequence[Segment], readings: int, template: _core.Template) -> TruePart:
    kind, _, number = part.partition("_")
    parent = f"{PARENT_KIND.get(kind)}_{number}"
    return TruePart(
        box=box,
        name=to_truth_name(part),
        parent=to_truth_name(parent) if parent in template.parts else None,
        extra=kind_of(part) == TUCK,
        angle_deg=None,
        corners=_rectangle(pieces),
        visible_px=readings,
    )


def _rectangle(pieces: Sequence[Segment]) -> tuple[Vector, Vector, Vector, Vector]:
    """The rectangle of the piece with most readings, in its plane, grown to hold the others'."""
    largest = max(pieces, key=lambda piece: piece.points)
    if len(pieces) == 1:
        return largest.rectangle
    origin, along, _, across = np.array(largest.rectangle)
    axes = np.array([along - origin, across - origin])
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    places = (np.concatenate([piece.rectangle for piece in pieces]) - origin) @ axes.T
    (left, near), (right, far) = places.min(axis=0), places.max(axis=0)
    first, second, third, fourth = origin + np.array([(left, near), (right, near), (right, far), (left, far)]) @ axes
    return vector(first), vector(second), vector(third), vector(fourth)


def _refuse_clockwise(
    form: Form, box: str, numbers_of: Mapping[Role, Sequence[int]], segmentation: Segmentation
) -> None:
    mine = {role.part: [segmentation.segments[k] for k in ks] for role, ks in numbers_of.items() if role.box == box}
    if goes_clockwise(mine, segmentation.up):
        first = min(k for role, ks in numbers_of.items() if role.box == box for k in ks)
        whose = f"box {box!r}" if box else "the box"
        raise ValueError(
            f"{form.place(first)}: {whose} is numbered clockwise seen from above; number its sides and flaps the other "
            "way round"
        )
