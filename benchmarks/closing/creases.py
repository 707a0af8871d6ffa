"""Classes of creases as the planner is told of them."""

from __future__ import annotations

from boxwright.planning import assumed
from boxwright.simulation.physics import crease_class


def told(crease: str) -> dict:
    """What the planner is told of a class of creases: whoever closes boxes knows theirs."""
    figures = crease_class(crease)
    return assumed(
        moment_n_m_per_m=figures.moment_n_m_per_m, board_m=figures.board_mm / 1000.0, return_rad=figures.return_rad
    )
