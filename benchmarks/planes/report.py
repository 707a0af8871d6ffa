"""Sums of frames' scores, and tables of them as Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from planes.score import MIN_READINGS, FrameScore, PanelScore
from planes.truth import ROLES

Share = tuple[int, int]
"""Hits and how many there were."""


def recall(scores: Sequence[FrameScore], *, paired: bool, small: bool = False) -> Share:
    """Panels found, of all or of the small ones; `paired` counts a flap in its side's plane and the side as one."""
    return _share(panel.found for panel in _panels(scores, paired) if panel.small or not small)


def by_role(scores: Sequence[FrameScore], *, paired: bool) -> dict[str, Share]:
    """Panels found of each role that occurs, of the small ones and in all."""
    panels = _panels(scores, paired)
    rows = {role: _share(panel.found for panel in panels if panel.role == role) for role in ROLES}
    rows |= {"small": recall(scores, paired=paired, small=True), "all": recall(scores, paired=paired)}
    return {role: share for role, share in rows.items() if share[1]}


def precision(scores: Sequence[FrameScore], least: int) -> Share:
    """Precise segments among those of at least so many readings."""
    return _share(segment.precise for frame in scores for segment in frame.segments if segment.readings >= least)


def missed(scores: Sequence[FrameScore]) -> list[str]:
    """A line for each panel or pair that no segment finds."""
    return [
        f"missed: {frame.name:<16}{panel.name:<20}{panel.readings:>8} readings, "
        f"IoU {panel.iou:.2f}, in segments {panel.covered:.2f}"
        for frame in scores
        for panel in frame.paired
        if not panel.found
    ]


def percent(share: Share) -> str:
    return f"{100 * share[0] / share[1]:.1f}" if share[1] else "-"


def milliseconds(times: Sequence[float]) -> tuple[str, str]:
    """Median and 99th percentile."""
    return tuple(f"{value:.1f}" if value < 100 else f"{value:.0f}" for value in np.percentile(times, (50, 99)))


def summary_row(name: str, times: Sequence[float], scores: Sequence[FrameScore]) -> list[str]:
    """A row below `SUMMARY`."""
    shares = [recall(scores, paired=True), recall(scores, paired=True, small=True), recall(scores, paired=False)]
    shares += [precision(scores, MIN_READINGS), precision(scores, 0)]
    return [name, str(len(times)), *milliseconds(times), *map(percent, shares)]


SUMMARY = [
    "method",
    "frames",
    "CPU ms, median",
    "99th",
    "recall %",
    "small %",
    "pairs as two %",
    "precision %",
    "all segments %",
]


def role_rows(columns: dict[str, Sequence[FrameScore]]) -> list[list[str]]:
    """Recall by role: a row for each role, pairs as one, then as two; a column for each method."""
    rows = []
    for paired in (True, False):
        tables = [by_role(scores, paired=paired) for scores in columns.values()]
        for role in tables[0]:
            name = role if paired else f"{role}, pairs as two"
            rows.append([name, *(_of(table.get(role, (0, 0))) for table in tables)])
    return rows


def markdown(heading: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [heading, ["---"] + ["---:"] * (len(heading) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def _of(share: Share) -> str:
    return f"{share[0]} of {share[1]} ({percent(share)} %)"


def _panels(scores: Sequence[FrameScore], paired: bool) -> list[PanelScore]:
    return [panel for frame in scores for panel in (frame.paired if paired else frame.apart)]


def _share(hits: Iterable[bool]) -> Share:
    flags = list(hits)
    return sum(flags), len(flags)
