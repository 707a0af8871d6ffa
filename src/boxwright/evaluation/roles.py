"""Names of panels, and which true panel a predicted name stands for under one of the four rotations of a box."""

from __future__ import annotations

import re

ROTATIONS = (0, 1, 2, 3)
"""The four rotations of a box: under rotation r, predicted side k is true side (k + r) modulo 4."""

FLAP = "flap"

TUCK = "tuck"
"""A flap on a flap: counted apart. All other kinds count as panels of the full model."""

TRUE_NAME = re.compile(r"(?P<kind>[a-z]+)(?P<number>\d*)")


def from_truth_name(name: str) -> str:
    """`side_0` for a truth's `side0`; `base` stays. Raises ValueError for a name that is neither."""
    match = TRUE_NAME.fullmatch(name)
    if match is None:
        raise ValueError(f"truth: parts: name is {name!r}; must be lower-case letters, then a number where it has one")
    return f"{match['kind']}_{match['number']}" if match["number"] else match["kind"]


def to_truth_name(name: str) -> str:
    """`side0` for a part `side_0`: how a truth writes it. Raises ValueError for a name that no truth can tell."""
    written = name.replace("_", "", 1)
    if TRUE_NAME.fullmatch(written) is None or from_truth_name(written) != name:
        raise ValueError(f"part {name!r}: no truth can tell it; must be lower-case letters, or these, _ and a number")
    return written


def kind_of(name: str) -> str:
    """The kind of a panel: `flap` for `flap_3`."""
    return name.partition("_")[0]


def rotated(name: str, rotation: int) -> str:
    """The true panel that a predicted name stands for under a rotation; names without a number stay."""
    kind, separator, number = name.partition("_")
    if not separator or not number.isdecimal():
        return name
    return f"{kind}_{(int(number) + rotation) % len(ROTATIONS)}"
