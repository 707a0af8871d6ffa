"""Each point of full accuracy that a frame loses, laid to one cause.

Lost are, of each box that is asked for, the panels in the cloud that no right part holds, and the wrong parts:
together, panels in the cloud - right + wrong (docs/formats.md, "The figures of merit"; flaps on flaps apart). A panel
that is given another role is lost twice: once itself, once as the wrong part. A segment finds a panel where at least
half of its points lie on the panel and it holds at least half of the panel's readings. The panels of a box without an
object count as missed with it, whether perception found them or not.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import BoxScore, FrameScore, SetEntry, read_entry, score_frame
from boxwright.evaluation.overlap import Overlap, count_overlap
from boxwright.evaluation.roles import TUCK, kind_of, rotated
from boxwright.evaluation.verdicts import PANEL_READINGS, true_panels
from boxwright.io.clouds import read_cloud
from boxwright.pipeline import infer
from boxwright.types import Object, Truth

Counts = NDArray[np.int64]

MERGED = "not found by perception: merged with its coplanar neighbour"
MERGED_ELSEWHERE = "not found by perception: merged with something else"
BROKEN = "not found by perception: broken into pieces"
NO_SEGMENT = "not found by perception: not a segment"
LEFT_OUT = "found, but left out by inference"
OTHER_ROLE = "found, but given another role"
ROLE_SPOILT = "found and given its role, but with other points"
BOX_MISSED = "box missed altogether"
CLUTTER = "wrong part: clutter or another box taken for it"
OTHER_PANEL = "wrong part: another panel of the box taken for it"
PIECE = "wrong part: a piece of a panel taken"
CAUSES = (MERGED, MERGED_ELSEWHERE, BROKEN, NO_SEGMENT, LEFT_OUT, OTHER_ROLE, ROLE_SPOILT, BOX_MISSED)
CAUSES += (CLUTTER, OTHER_PANEL, PIECE)

FOUND_SHARE = 0.5
MERGED_SHARE = 0.25
"""A segment that holds so much of a second panel of the box has merged the two."""


@dataclass(frozen=True)
class Loss:
    """One lost point; `accuracy` is what it takes from its box's full accuracy."""

    cause: str
    kind: str
    accuracy: float


@dataclass(frozen=True)
class Panel:
    """A true panel in the cloud, whether perception finds it, and whether its box got no object."""

    kind: str
    found: bool
    box_missed: bool


@dataclass(frozen=True)
class Judged:
    """A frame's score, its lost points, and the panels in the cloud of the boxes that are asked for."""

    score: FrameScore
    losses: list[Loss]
    panels: list[Panel]
    refused: bool


@dataclass(frozen=True)
class Seen:
    """Points of each segment (last row: in none) that lie on each true panel (last column: on none)."""

    on_true: Counts
    holders: list[tuple[int, int]]
    """The object and part that most points of each segment were given to; -1 for none."""

    def finder(self, panel: int) -> int | None:
        """The segment that finds a true panel."""
        segments, readings = self.on_true[:-1], self.on_true[:, panel].sum()
        for s in np.flatnonzero(segments[:, panel] >= FOUND_SHARE * readings):
            if segments[s, panel] >= FOUND_SHARE * segments[s].sum():
                return int(s)
        return None

    def why_not_found(self, panel: int, siblings: list[int]) -> str:
        """Why no segment finds a true panel; `siblings` are the other panels of its box."""
        mine, readings = self.on_true[:-1, panel], self.on_true.sum(0)
        if mine.sum() < FOUND_SHARE * readings[panel]:
            return NO_SEGMENT
        main = self.on_true[int(np.argmax(mine))]
        large = [i for i in siblings if readings[i] >= PANEL_READINGS]
        if any(main[i] >= MERGED_SHARE * readings[i] for i in large):
            return MERGED
        return BROKEN if mine.max() < FOUND_SHARE * readings[panel] else MERGED_ELSEWHERE


def see(segments: Counts, objects: Counts, parts: Counts, labels: Counts, truth: Truth) -> Seen:
    """Counts what the segments hold; all arrays are (N,), -1 for none, `labels` 0 for none."""
    rows, columns = int(segments.max(initial=-1)) + 2, len(truth.parts) + 1
    row, column = np.where(segments < 0, rows - 1, segments), np.where(labels == 0, columns, labels) - 1
    on_true = np.bincount(row * columns + column, minlength=rows * columns).reshape(rows, columns)
    holders = []
    for s in range(rows - 1):
        pairs, counts = np.unique(np.stack((objects, parts))[:, segments == s], axis=1, return_counts=True)
        k, part = pairs[:, np.argmax(counts)] if counts.size else (-1, -1)
        holders.append((int(k), int(part)))
    return Seen(on_true, holders)


def missed_panel(name: str, box: BoxScore, seen: Seen, panels: dict[str, int], part_names: list[str]) -> str:
    """Why no right part holds a panel in the cloud."""
    if box.object is None or box.rotation is None:
        return BOX_MISSED
    segment = seen.finder(panels[name])
    if segment is None:
        return seen.why_not_found(panels[name], [i for i in panels.values() if i != panels[name]])
    k, part = seen.holders[segment]
    if k < 0 or part < 0:
        return LEFT_OUT
    in_its_role = k == box.object and rotated(part_names[part], box.rotation) == name
    return ROLE_SPOILT if in_its_role else OTHER_ROLE


def wrong_part(on_true: Counts, role: str, panels: dict[str, int]) -> str:
    """What a wrong part really is; `on_true` are its points on each true panel."""
    on_role = on_true[panels[role]] if role in panels else 0
    on_box = on_true[list(panels.values())].sum()
    if 2 * on_role >= on_true.sum():
        return PIECE
    return CLUTTER if on_true.sum() - on_box >= on_box - on_role else OTHER_PANEL


def box_losses(box: BoxScore, part_names: list[str], overlap: Overlap, seen: Seen, truth: Truth) -> list[Loss]:
    """The lost points of a box; `part_names` are those of its object."""
    panels = true_panels(truth, box.box)
    lost = [(missed_panel(n, box, seen, panels, part_names), n) for n in box.missed if kind_of(n) != TUCK]
    for v in box.verdicts:
        if box.object is not None and v.verdict == "wrong" and kind_of(v.name) != TUCK:
            on_true = overlap.part_on_true[box.object][part_names.index(v.name)]
            lost.append((wrong_part(on_true, v.role, panels), v.role))
    share = 1.0 / box.panels_in_cloud if box.panels_in_cloud else 0.0
    return [Loss(cause, kind_of(name), share) for cause, name in lost]


def judge(entry: SetEntry, method: str) -> Judged:
    """Infers and scores one frame. As in `boxwright evaluate`, a refused cloud is answered with no object."""
    frame = read_entry(entry)
    truth, labels = frame.truth, frame.labels.astype(np.int64)
    objects: tuple[Object, ...] = ()
    segments = object_labels = part_labels = np.full(len(labels), -1)
    refused = False
    try:
        inferred = infer(read_cloud(entry.cloud_path), method=method)
    except ValueError:
        refused = True
    else:
        objects, segments = inferred.model.objects, inferred.perception.labels.astype(np.int64)
        object_labels, part_labels = inferred.object_labels.astype(np.int64), inferred.part_labels.astype(np.int64)
    score = score_frame(objects, object_labels, part_labels, truth, labels)
    overlap = count_overlap(objects, object_labels, part_labels, truth, labels)
    seen = see(segments, object_labels, part_labels, labels, truth)
    losses, there = [], []
    for box in score.boxes:
        names = [] if box.object is None else [part.name for part in objects[box.object].parts]
        losses += box_losses(box, names, overlap, seen, truth)
        for name, i in true_panels(truth, box.box).items():
            if overlap.readings[i] >= PANEL_READINGS and kind_of(name) != TUCK:
                there.append(Panel(kind_of(name), seen.finder(i) is not None, box.object is None))
    return Judged(score, losses, there, refused)
