"""What is assumed of the board that boxes are made of where nobody tells: facts, with their sources."""

from __future__ import annotations

BOARD_G_PER_M2 = 550.0
"""Single-wall board of common papers: two liners of 175 g/m2, a medium of 140 g/m2 by C flute's take-up, about 1.43."""

BOARD_THICKNESS_M = 0.004
"""C flute, nominally 5/32 inch (Fibre Box Association)."""
