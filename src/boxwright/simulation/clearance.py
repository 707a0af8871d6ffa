"""Boards never pass through each other: which panels do, and flap angles at which none does."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.simulation.boxes import Flap, OpenBox
from boxwright.simulation.panels import Panel, build_panels
from boxwright.simulation.poses import apply

Array = NDArray[np.float64]

BOARD_GAP_M = 0.0003
"""Boards that are not folded from one another keep this apart."""
REPAIRS = 40


def bodies_closer(bodies: list[Array], gap_m: float) -> list[tuple[int, int]]:
    """Index pairs of bodies, each triangles (T, 3, 3), whose surfaces cross or come nearer than `gap_m`."""
    groups = np.repeat(np.arange(len(bodies), dtype=np.int32), [len(body) for body in bodies])
    return _core.close_surface_groups(np.concatenate(bodies), groups, gap_m)


def is_clear_of(body: Array, others: list[Array], gap_m: float) -> bool:
    """Does a body keep `gap_m` to all the others, whatever these do to one another?"""
    if not others:
        return True
    groups = np.zeros(len(body) + sum(len(other) for other in others), dtype=np.int32)
    groups[len(body) :] = 1
    return not _core.close_surface_groups(np.concatenate([body, *others]), groups, gap_m)


def crossing_panels(panels: list[Panel]) -> list[tuple[Panel, Panel]]:
    """Pairs of boards that cross, other than those folded from one another at a shared edge."""
    pairs = bodies_closer([panel.triangles for panel in panels], BOARD_GAP_M)
    found = [(panels[a], panels[b]) for a, b in pairs]
    return [(a, b) for a, b in found if not _are_folded(a, b)]


def _are_folded(a: Panel, b: Panel) -> bool:
    body = ("base", "side0", "side1", "side2", "side3", "top")
    return (a.name in body and b.name in body) or a.name == b.parent or b.name == a.parent


def free_flaps(rng: np.random.Generator, box: OpenBox, world_from_box: Array) -> OpenBox | None:
    """The box with flaps moved until no board crosses another or the support (world z = 0); None if that failed."""
    for _ in range(REPAIRS):
        panels = build_panels(box)
        sunk = [panel for panel in panels if panel.parent is not None and _lowest_m(panel, world_from_box) < 0.001]
        pairs = crossing_panels(panels)
        if not sunk and not pairs:
            return box
        moves = {_flap_index(panel): -_step(rng) for panel in sunk}
        for pair in pairs:
            k = _one_to_move(rng, box, pair)
            moves.setdefault(k, _step(rng) if _angle(box, k) < np.pi else -_step(rng))
        box = _with_moved_flaps(box, moves)
    return None


def _lowest_m(panel: Panel, world_from_box: Array) -> float:
    return float(apply(world_from_box, panel.triangles)[..., 2].min())


def _step(rng: np.random.Generator) -> float:
    return float(np.radians(rng.uniform(3.0, 14.0)))


def _flap_index(panel: Panel) -> int:
    return int(panel.name[-1])


def _angle(box: OpenBox, k: int) -> float:
    flap = box.flaps[k]
    return 0.0 if flap is None else flap.angle_rad


def _one_to_move(rng: np.random.Generator, box: OpenBox, pair: tuple[Panel, Panel]) -> int:
    """Of two boards the flap that is less than half open, else either."""
    flaps = sorted({_flap_index(panel) for panel in pair if panel.parent is not None})
    leaning = [k for k in flaps if _angle(box, k) < np.pi / 2]
    choice = leaning or flaps
    return choice[int(rng.integers(len(choice)))]


def _with_moved_flaps(box: OpenBox, moves: dict[int, float]) -> OpenBox:
    def moved(k: int, flap: Flap | None) -> Flap | None:
        if flap is None or k not in moves:
            return flap
        return msgspec.structs.replace(flap, angle_rad=flap.angle_rad + moves[k])

    first, second, third, fourth = (moved(k, flap) for k, flap in enumerate(box.flaps))
    return msgspec.structs.replace(box, flaps=(first, second, third, fourth))
