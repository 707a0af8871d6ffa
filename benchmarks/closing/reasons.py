"""Why flaps that can be closed are not, as kinds of reasons that can be counted."""

from __future__ import annotations

import re

UNLIKE = (
    (r"^at -?\d+ degrees: ", "on its way: "),
    (r"\b(flap|side|tuck)_\d+", r"a \1"),
    (r"-?\d+(\.\d+)? (degrees|mm)", r"some \2"),
)
"""What differs from flap to flap, and what is told in its place."""


def kind_of(status: str, reason: str | None, failure: str | None, stopped: str | None = None) -> str:
    """Why a flap is not held: the planner's words without names and numbers, or what the run of its plan was."""
    if status == "planned":
        if failure:
            return "planned, but the run proves nothing"
        return "planned, but the arm was stopped" if stopped else "planned, but not held"
    alike = reason or "not told"
    for pattern, instead in UNLIKE:
        alike = re.sub(pattern, instead, alike)
    return f"{status}: {alike}"
