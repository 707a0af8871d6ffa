"""What the planner is told of folds and weight, which no camera sees: how hard a box may be pushed follows from it."""

from __future__ import annotations

from typing import Any

from boxwright.types.checks import require_positive


def assumed(
    *, moment_n_m_per_m: float, board_m: float, return_rad: float, mass_kg: float | None = None
) -> dict[str, Any]:
    """Planning settings for creases that take this moment, per metre in board of `board_m`, and give back `return_rad`.

    `mass_kg` is that of box and contents; the planner's own assumption holds where it is None. Raises ValueError for a
    figure that is not positive.
    """
    told = {
        "crease_n_m_per_m": moment_n_m_per_m,
        "crease_board_m": board_m,
        "crease_return_rad": return_rad,
    }
    if mass_kg is not None:
        told["mass_kg"] = mass_kg
    for name, value in told.items():
        require_positive(name, [value])
    return {"assumed": told}
