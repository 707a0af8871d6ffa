"""Accuracy by how much is seen of a box, what flaps are lost to, and how the lost ones are seen, as Markdown."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from benchmarks.gallery.how_seen import SIGHTS, SeenFlap

LEAST_PANELS = 3
"""Fewer are no box (docs/maths.md, "Whether it is one")."""
Box = dict[str, Any]


def boxes_of(evaluation: dict[str, Any]) -> Iterator[tuple[int, Box]]:
    """Each box with how many there are in its frame."""
    for frame in evaluation["frames"]:
        for box in frame["boxes"]:
            yield len(frame["boxes"]), box


def full_share(box: Box) -> float:
    """Full model accuracy of one box."""
    return float((box["panels_right"] - box["panels_wrong"]) / box["panels_in_cloud"])


def flap_share(box: Box) -> float:
    """Flap accuracy of one box that has flaps in the cloud."""
    return float((box["flaps_right"] - box["flaps_wrong"]) / box["flaps_in_cloud"])


def table(name: str, boxes: list[tuple[int, Box]], of: Callable[[int, Box], str]) -> list[str]:
    """Accuracy of boxes by what `of` says of them, as Markdown."""
    lines = [f"| {name} | boxes | missed | flap % | full % |", "|---|---:|---:|---:|---:|"]
    for value in sorted({of(count, box) for count, box in boxes}):
        lines.append(row(value, [box for count, box in boxes if of(count, box) == value]))
    return [*lines, ""]


def row(value: str, some: list[Box]) -> str:
    """Accuracy of some boxes, as a line of a table."""
    flaps = [flap_share(box) for box in some if box["flaps_in_cloud"]]
    flap = f"{100 * np.mean(flaps):.1f}" if flaps else "-"
    missed = sum(box["object"] is None for box in some)
    return f"| {value} | {len(some)} | {missed} | {flap} | {100 * np.mean([*map(full_share, some)]):.1f} |"


def by_panels(boxes: list[tuple[int, Box]]) -> list[str]:
    """By how many panels are in the cloud, and of all that show enough of them to be told."""
    *lines, end = table("panels of the box in the cloud", boxes, lambda _, box: panels_seen(box))
    told = [box for _, box in boxes if box["panels_in_cloud"] >= LEAST_PANELS]
    return [*lines, row(f"{LEAST_PANELS} and more, which may be told", told), end]


def panels_seen(box: Box) -> str:
    """How many panels of it are in the cloud, in words that sort."""
    count = box["panels_in_cloud"]
    return "1 or 2" if count < LEAST_PANELS else "3 to 5" if count < 6 else "6 and more"


def causes(boxes: list[tuple[int, Box]]) -> list[str]:
    """Points of flap accuracy that each cause costs, as Markdown."""
    asked = [box for _, box in boxes if box["flaps_in_cloud"]]
    lost = {"the whole box was missed": 0.0, "a flap of a box that was found": 0.0, "a part told as a wrong flap": 0.0}
    for box in asked:
        gone = box["flaps_in_cloud"] - box["flaps_right"]
        cause = "the whole box was missed" if box["object"] is None else "a flap of a box that was found"
        lost[cause] += gone / box["flaps_in_cloud"]
        lost["a part told as a wrong flap"] += box["flaps_wrong"] / box["flaps_in_cloud"]
    rows = [f"| {cause} | {100 * points / len(asked):.1f} |" for cause, points in lost.items()]
    return ["| cause | points of flap accuracy |", "|---|---:|", *rows, ""]


def by_sight(flaps: list[SeenFlap]) -> list[str]:
    """Flaps in the cloud and lost ones, by how they are seen, as Markdown."""
    lines = ["| how the flap is seen | flaps in the cloud | lost | of them with their box |", "|---|---:|---:|---:|"]
    for name in (*SIGHTS, None):
        mine = [flap for flap in flaps if name in (flap.sight, None)]
        lost = [flap for flap in mine if flap.is_lost]
        with_box = sum(flap.is_box_missed for flap in lost)
        lines.append(f"| {name or 'all'} | {len(mine)} | {len(lost)} | {with_box} |")
    return [*lines, ""]
