"""Colours of all pictures."""

from __future__ import annotations

from typing import Literal

SEGMENTS = (
    "#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377",
    "#ee8866", "#44bb99", "#7a5195", "#99ddff", "#bbcc33", "#ffaabb",
)  # fmt: skip
"""Segments in turn; distinct for colour-blind readers too (after Paul Tol's bright and light schemes)."""

SIDE = "#2c4464"
FLAP = "#f5b94a"
TUCK = "#fbdc95"
BASE = "#f3e6c4"
INK = "#20242b"
FAINT = "#b9bec7"

KINDS = {"side": SIDE, "flap": FLAP, "tuck": TUCK, "base": BASE}
"""Sides dark, flaps and base light, as in the paper's figure."""

OTHER_KIND = "#9fb7d3"


Line = tuple[str, tuple[float, tuple[float, ...]] | Literal["-"]]

SIDES: dict[str, Line] = {
    "edge": (INK, "-"),
    "crease": ("#117733", (0, (6.0, 2.0))),
    "occluded": ("#cc3311", (0, (1.2, 1.2))),
    "border": ("#0077bb", (0, (5.0, 1.5, 1.2, 1.5))),
}
"""Colour and dashes of a rectangle's side, by what ends the segment there."""


def of_segment(segment: int) -> str:
    """The colour of a segment, by its number."""
    return SEGMENTS[segment % len(SEGMENTS)]


def of_part(name: str) -> str:
    """The colour of a part, by its kind: what stands before the number in `side_0`."""
    return KINDS.get(name.partition("_")[0], OTHER_KIND)


def of_group(group: int) -> str:
    """The colour of a group, by its number; the background has none of its own."""
    return FAINT if group < 0 else SEGMENTS[group % len(SEGMENTS)]
