"""Scores a segmentation of a frame, whoever made it, against the frame's true planes.

A panel of at least 500 readings is found where a segment and it have an intersection over union of at least 0.5. A
segment of at least 500 readings is precise where it has that with a true plane of any size: a panel, a pair of panels
in one plane, or a flat face of anything else. All readings of a segment count, on a true face or not.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.types import Truth
from planes.truth import TruePlane, panels_apart, panels_paired

MIN_READINGS = 500
SMALL_READINGS = 2000
"""Panels with fewer are small."""
MIN_IOU = 0.5

Counts = NDArray[np.int64]


@dataclass(frozen=True)
class PanelScore:
    """A true panel or pair of at least 500 readings."""

    name: str
    role: str
    readings: int
    iou: float
    """With the segment that fits best."""
    covered: float
    """Share of its readings in any segment."""

    @property
    def found(self) -> bool:
        return self.iou >= MIN_IOU

    @property
    def small(self) -> bool:
        return self.readings < SMALL_READINGS


@dataclass(frozen=True)
class SegmentScore:
    """A segment and the intersection over union with the true plane that fits best."""

    readings: int
    iou: float

    @property
    def precise(self) -> bool:
        return self.iou >= MIN_IOU


@dataclass(frozen=True)
class FrameScore:
    """`paired` counts a flap in its side's plane and that side as one panel, `apart` as two."""

    name: str
    paired: tuple[PanelScore, ...]
    apart: tuple[PanelScore, ...]
    segments: tuple[SegmentScore, ...]


def score_frame(truth: Truth, faces: NDArray[np.integer], labels: NDArray[np.integer]) -> FrameScore:
    """Score `labels` (N,), a segment's number for each point, -1 for none, against `faces` (N,), 0 for none.

    Raises ValueError where the two are not as many, or a number is out of range.
    """
    if faces.shape != labels.shape or faces.ndim != 1:
        raise ValueError(f"{truth.name}: faces {faces.shape}, labels {labels.shape}; both must be (N,), as many")
    known = len(truth.parts) + len(truth.faces)
    if faces.size and (int(faces.max()) > known or int(labels.min()) < -1):
        raise ValueError(f"{truth.name}: faces go to {faces.max()} of {known}, labels from {labels.min()}; -1 is none")
    on_face = _on_face(faces.astype(np.int64), labels.astype(np.int64), known)
    paired, apart = panels_paired(truth), panels_apart(truth)
    rest = [TruePlane("", "face", (k,)) for k in range(len(truth.parts) + 1, known + 1)]
    sizes = on_face[:, 1:].sum(axis=0)
    best = _ious([*apart, *paired, *rest], on_face).max(axis=0, initial=0.0)
    return FrameScore(
        truth.name,
        _panel_scores(paired, on_face),
        _panel_scores(apart, on_face),
        tuple(SegmentScore(int(n), float(iou)) for n, iou in zip(sizes, best, strict=True) if n > 0),
    )


def _on_face(faces: Counts, labels: Counts, known: int) -> Counts:
    """(known + 1, S + 1): readings of each face (row 0: none) in each segment (column 0: none)."""
    columns = int(labels.max(initial=-1)) + 2
    flat = np.bincount(faces * columns + labels + 1, minlength=(known + 1) * columns)
    return flat.reshape(known + 1, columns)


def _ious(planes: list[TruePlane], on_face: Counts) -> NDArray[np.float64]:
    """(planes, S)."""
    both = np.array([on_face[list(plane.faces)].sum(axis=0) for plane in planes]).reshape(len(planes), -1)
    union = both.sum(axis=1)[:, None] + on_face[:, 1:].sum(axis=0)[None, :] - both[:, 1:]
    ious: NDArray[np.float64] = both[:, 1:] / np.maximum(union, 1)
    return ious


def _panel_scores(planes: list[TruePlane], on_face: Counts) -> tuple[PanelScore, ...]:
    ious = _ious(planes, on_face).max(axis=1, initial=0.0)
    scores = []
    for plane, iou in zip(planes, ious, strict=True):
        readings = int(on_face[list(plane.faces)].sum())
        if readings >= MIN_READINGS:
            in_any = int(on_face[list(plane.faces), 1:].sum())
            scores.append(PanelScore(plane.name, plane.role, readings, float(iou), in_any / readings))
    return tuple(scores)
