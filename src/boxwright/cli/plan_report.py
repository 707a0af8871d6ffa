"""What `boxwright plan` and `boxwright close` print."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from boxwright.types import Plan

NOT_CLOSED = 3
"""Exit status when some flap was not closed (docs/formats.md)."""

NEEDS_NOTHING = ("planned", "already_closed", "absent")
"""What a flap may be where a plan leaves nothing open that could be closed."""


def exit_status(plan: Plan, lacking: Collection[str] = ()) -> int:
    """0 when every flap is closed, or needs no closing; 3 when one stays open.

    A hidden flap that the box is known to lack (`lacking`) needs no closing.
    """
    needed = (name for name, flap in plan.flaps.items() if flap.status not in NEEDS_NOTHING)
    is_open = any(plan.flaps[name].status != "hidden" or name not in lacking for name in needed)
    return NOT_CLOSED if is_open else 0


def print_plan(plan: Plan, files: Sequence[Path], *, as_json: bool) -> None:
    """A table of flaps, how long the motion takes and what a user should know; or the record itself."""
    import msgspec

    from boxwright.cli.failures import warn
    from boxwright.cli.screen import console, table

    for line in plan.warnings:
        warn(line)
    if as_json:
        print(msgspec.json.encode(plan).decode())
        return
    rows = table(f"{plan.robot}, {plan.method} planner", "flap", "status")
    rows.add_column("why", overflow="fold")
    for name in (*plan.order, *(name for name in plan.flaps if name not in plan.order)):
        flap = plan.flaps[name]
        rows.add_row(name, flap.status, " ".join(filter(None, (flap.reason, _move(plan, name)))))
    screen = console()
    screen.print(rows)
    motion_s = plan.segments[-1].times[-1] if plan.segments else 0.0
    screen.print(f"planned in {plan.seconds:.2f} s; the motion takes {motion_s:.1f} s", soft_wrap=True)
    for path in files:
        print(path)


def _move(plan: Plan, name: str) -> str | None:
    move = plan.flaps[name].move
    if move is None:
        return None
    import math

    parts = [
        f"{axis} {1000.0 * value:+.0f} mm"
        for axis, value in (("x", move.x_m), ("y", move.y_m), ("z", move.z_m))
        if abs(value) > 0.0
    ]
    if move.yaw_rad:
        parts.append(f"yaw {math.degrees(move.yaw_rad):+.0f} degrees")
    return f"(would work with the base moved by {', '.join(parts)})"
