"""The kinds of boxes, by category: each draws one box. Sizes in metres.

Styles follow the FEFCO code where it has them: 0201 regular slotted (rsc), 0202 and 0203 overlapping flaps, 0200 half
slotted, 0209 short flaps (gap), 0215 and the 0400s for boxes with tucks and lids. Board: single-wall corrugated is
1.5-5 mm (flutes E to A), double-wall 6-7 mm, cake boxes are of 1-2 mm, pizza boxes of E or B flute, 1.5-3 mm.
"""

from __future__ import annotations

from collections.abc import Callable

import msgspec
import numpy as np

from boxwright.simulation.boxes import Flap, OpenBox, Rgb, Tuck
from boxwright.simulation.states import LYING, part_shut, set_up

Rng = np.random.Generator
Draw = Callable[[Rng, str, str], OpenBox]
Flaps = tuple[Flap | None, Flap | None, Flap | None, Flap | None]

BROWNS: tuple[Rgb, ...] = ((196, 150, 98), (181, 136, 90), (208, 166, 115), (160, 120, 80))
WHITES: tuple[Rgb, ...] = ((236, 234, 228), (222, 214, 200), (240, 205, 210), (196, 150, 98))

SIZES_M: dict[str, tuple[tuple[float, float], tuple[float, float], tuple[float, float]]] = {
    "small": ((0.17, 0.27), (0.12, 0.20), (0.08, 0.18)),
    "medium": ((0.28, 0.42), (0.22, 0.32), (0.17, 0.28)),
    "large": ((0.44, 0.62), (0.32, 0.44), (0.26, 0.42)),
    "carton": ((0.20, 0.33), (0.16, 0.26), (0.28, 0.45)),
    "cake": ((0.20, 0.32), (0.18, 0.30), (0.10, 0.20)),
    "pizza": ((0.26, 0.42), (0.26, 0.42), (0.035, 0.06)),
    "tote": ((0.26, 0.60), (0.18, 0.40), (0.08, 0.34)),
}
BOARDS_M = {"cake": (0.001, 0.002), "pizza": (0.0015, 0.003), "small": (0.003, 0.005)}
CORRUGATED_M = (0.003, 0.007)


def _between(rng: Rng, span: tuple[float, float]) -> float:
    return float(rng.uniform(*span))


def _angle_rad(rng: Rng) -> float:
    """From nearly closed to hanging below the rim."""
    spans = ((10.0, 25.0), (25.0, 60.0), (60.0, 130.0), (130.0, 190.0), (190.0, 238.0))
    return float(np.radians(_between(rng, spans[rng.choice(5, p=(0.12, 0.12, 0.30, 0.24, 0.22))])))


def _bend_rad(rng: Rng) -> float:
    return float(np.radians(rng.choice((0.0, rng.normal(0, 4.0), rng.uniform(-18, 18)), p=(0.25, 0.6, 0.15))))


def _flap(rng: Rng, board_m: float, length_m: float, taper_m: float = 0.0, tuck: Tuck | None = None) -> Flap:
    """A flap of a length, at any angle; a lid that ends in a tuck is stiffer."""
    inset_m = board_m / 2 + float(rng.uniform(0.0008, 0.003))
    uneven = rng.uniform(0.6, 1.0, 2) * taper_m
    bend_rad = _bend_rad(rng) / (3.0 if tuck else 1.0)
    return Flap(length_m, _angle_rad(rng), inset_m, bend_rad, float(uneven[0]), float(uneven[1]), tuck)


def _tuck(rng: Rng, length_m: float) -> Tuck:
    return Tuck(length_m, float(np.radians(rng.uniform(-90, 105))), taper_m=length_m * float(rng.uniform(0.0, 0.4)))


def _box(rng: Rng, category: str, variant: str, flaps: Callable[[float, float, float, float], Flaps]) -> OpenBox:
    """Draws the body; `flaps` (length, width, height, board) draws what hangs on it."""
    length, width, height = (_between(rng, span) for span in SIZES_M[category])
    board = _between(rng, BOARDS_M.get(category, CORRUGATED_M))
    soft = 0.006 if height > 0.08 else 0.002
    bulges = rng.normal(0, soft / 2, 4).clip(-soft, soft) * (rng.random() < 0.7)
    rack = float(np.radians(rng.normal(0, 2.0))) if rng.random() < 0.6 else 0.0
    colors = WHITES if category in ("cake", "pizza") else BROWNS
    color = colors[int(rng.integers(len(colors)))]
    first, second, third, fourth = (float(b) for b in bulges)
    return OpenBox(
        category, variant, length, width, height, board, flaps(length, width, height, board), rack,
        (first, second, third, fourth), color,
    )  # fmt: skip


def _four(rng: Rng, category: str, variant: str, share: tuple[float, float], taper: float = 0.0) -> OpenBox:
    """Four flaps of one length, a share of the width."""

    def flaps(_l: float, width: float, _h: float, board: float) -> Flaps:
        reach = width * _between(rng, share) - board
        first, second, third, fourth = (_flap(rng, board, reach, taper * reach * rng.random()) for _ in range(4))
        return first, second, third, fourth

    return _torn(rng, _pushed_in(rng, _box(rng, category, variant, flaps), 0.07), 0.06)


def _pushed_in(rng: Rng, box: OpenBox, chance: float) -> OpenBox:
    """Now and then one pair of opposite flaps lies just below the rim, the other pair leans over it."""
    if rng.random() > chance:
        return box
    inner = int(rng.integers(2))

    def moved(k: int) -> Flap | None:
        flap = box.flaps[k]
        if flap is None:
            return None
        if k % 2 != inner:
            return msgspec.structs.replace(flap, angle_rad=float(np.radians(rng.uniform(25.0, 70.0))))
        angle_rad = float(np.radians(rng.uniform(-12.0, -1.0)))
        # Flaps that go under others are slotted wider.
        return msgspec.structs.replace(flap, angle_rad=angle_rad, bend_rad=0.0, inset_m=flap.inset_m + 0.006)

    return msgspec.structs.replace(box, flaps=(moved(0), moved(1), moved(2), moved(3)))


def _torn(rng: Rng, box: OpenBox, chance: float) -> OpenBox:
    """Now and then a flap is torn off, another shortened; all four never."""
    flaps = list(box.flaps)
    for k in range(4):
        flap = flaps[k]
        if flap is None or rng.random() > chance or sum(f is not None for f in flaps) < 2:
            continue
        flaps[k] = None
    first, second, third, fourth = flaps
    return msgspec.structs.replace(box, flaps=(first, second, third, fourth))


def rsc(rng: Rng, category: str, variant: str) -> OpenBox:
    """Flaps that meet in the middle."""
    return _four(rng, category, variant, (0.5, 0.5), taper=0.06)


def overlap(rng: Rng, category: str, variant: str) -> OpenBox:
    """Flaps that overlap by a part of the width, up to the whole of it."""
    return _four(rng, category, variant, (0.62, 0.95))


def gap(rng: Rng, category: str, variant: str) -> OpenBox:
    """Flaps that leave the middle open."""
    return _four(rng, category, variant, (0.28, 0.42), taper=0.3)


def two_flaps(rng: Rng, category: str, variant: str) -> OpenBox:
    """Flaps on one pair of opposite sides."""
    first = int(rng.integers(2))

    def flaps(_l: float, width: float, _h: float, board: float) -> Flaps:
        reach = width / 2 - board
        pair = [None if k % 2 != first else _flap(rng, board, reach) for k in range(4)]
        return pair[0], pair[1], pair[2], pair[3]

    return _box(rng, category, variant, flaps)


def half_slotted(rng: Rng, category: str, variant: str) -> OpenBox:
    """No flap at all at the top."""
    return _box(rng, category, variant, lambda *_: (None, None, None, None))


def lipped(rng: Rng, category: str, variant: str) -> OpenBox:
    """A tote with a stiff lip round its rim: panels like flaps of one short length that lie flat outwards or droop."""

    def flaps(_l: float, _w: float, _h: float, board: float) -> Flaps:
        reach, angle_rad = _between(rng, (0.012, 0.06)), float(np.radians(_between(rng, (175.0, 215.0))))
        first, second, third, fourth = (Flap(reach, angle_rad, board / 2 + 0.001) for _ in range(4))
        return first, second, third, fourth

    return _box(rng, category, variant, flaps)


def uneven(rng: Rng, category: str, variant: str) -> OpenBox:
    """Four flaps, no two of one length, cut slanting."""

    def flaps(_l: float, width: float, _h: float, board: float) -> Flaps:
        reaches = rng.uniform(0.25, 0.75, 4) * width
        a, b, c, d = (_flap(rng, board, float(reach), 0.35 * float(reach) * rng.random()) for reach in reaches)
        return a, b, c, d

    return _torn(rng, _box(rng, category, variant, flaps), 0.05)


def _lid_box(
    rng: Rng,
    category: str,
    variant: str,
    *,
    tuck: tuple[float, float] | None,
    dust: tuple[float, float] | None,
    dust_taper: float,
    front: tuple[float, float] | None,
) -> OpenBox:
    """A lid as deep as the box on one side, maybe with a tuck; flaps on its neighbours and on the front. Metres."""
    lid_side = int(rng.integers(4))

    def flaps(length: float, width: float, _h: float, board: float) -> Flaps:
        depth, breadth = (width, length) if lid_side % 2 == 0 else (length, width)
        made: list[Flap | None] = [None] * 4
        lid_tuck = _tuck(rng, _between(rng, tuck)) if tuck else None
        made[lid_side] = _flap(rng, board, depth - board, 0.0, lid_tuck)
        if dust:
            reach = min(_between(rng, dust), 0.48 * breadth)
            made[(lid_side + 1) % 4] = _flap(rng, board, reach, dust_taper * reach)
            made[(lid_side + 3) % 4] = _flap(rng, board, reach, dust_taper * reach)
        if front:
            made[(lid_side + 2) % 4] = _flap(rng, board, _between(rng, front))
        return made[0], made[1], made[2], made[3]

    return _torn(rng, _box(rng, category, variant, flaps), 0.06)


def tuck_top(rng: Rng, category: str, variant: str) -> OpenBox:
    """Lid with a tuck, dust flaps beside it, nothing on the front."""
    return _lid_box(rng, category, variant, tuck=(0.025, 0.06), dust=(0.05, 0.12), dust_taper=0.3, front=None)


def lid(rng: Rng, category: str, variant: str) -> OpenBox:
    """Lid with a tuck and three short flaps."""
    return _lid_box(rng, category, variant, tuck=(0.02, 0.08), dust=(0.05, 0.10), dust_taper=0.1, front=(0.04, 0.10))


def plain_lid(rng: Rng, category: str, variant: str) -> OpenBox:
    """A lid alone."""
    return _lid_box(rng, category, variant, tuck=None, dust=None, dust_taper=0.0, front=None)


def pizza(rng: Rng, category: str, variant: str) -> OpenBox:
    """Lid with a front tuck, small flaps on the sides, a small flap on the front."""
    return _lid_box(rng, category, variant, tuck=(0.025, 0.045), dust=(0.025, 0.05), dust_taper=0.3, front=(0.03, 0.06))


def pizza_wings(rng: Rng, category: str, variant: str) -> OpenBox:
    """Lid with a front tuck and small flaps on the sides."""
    return _lid_box(rng, category, variant, tuck=(0.025, 0.045), dust=(0.025, 0.05), dust_taper=0.5, front=None)


def pizza_tuck(rng: Rng, category: str, variant: str) -> OpenBox:
    """Lid with a front tuck and nothing else."""
    return _lid_box(rng, category, variant, tuck=(0.025, 0.05), dust=None, dust_taper=0.0, front=None)


KINDS: dict[str, dict[str, Draw]] = {
    "small": {"rsc": rsc, "overlap": overlap, "gap": gap, "mailer": tuck_top},
    "medium": {"rsc": rsc, "overlap": overlap, "two_flaps": two_flaps, "half_slotted": half_slotted},
    "large": {"rsc": rsc, "overlap": overlap, "two_flaps": two_flaps, "gap": gap},
    "carton": {"uneven": uneven, "tuck_top": tuck_top, "tall_rsc": rsc},
    "cake": {"lid": lid, "tuck": tuck_top, "plain_lid": plain_lid},
    "pizza": {"pizza": pizza, "wings": pizza_wings, "tuck": pizza_tuck, "plain_lid": plain_lid},
}
"""Kinds by category and variant name."""


def upright(rng: Rng, category: str, variant: str) -> OpenBox:
    """A box as it is set up: all flaps stand in their sides' planes."""
    return _as(set_up(rng, _with_flaps(rng, ("small", "medium", "large", "carton"))), category, variant)


def closing(rng: Rng, category: str, variant: str) -> OpenBox:
    """A box on its way to being closed: some flaps shut."""
    return _as(part_shut(rng, _with_flaps(rng, tuple(KINDS))), category, variant)


def on_its_side(rng: Rng, category: str, variant: str) -> OpenBox:
    """A box that somebody laid down: any but the flat ones."""
    categories = ("small", "medium", "large", "carton", "cake")
    return _as(draw_box(rng, categories[int(rng.integers(len(categories)))]), category, variant)


def sealed(rng: Rng, category: str, variant: str) -> OpenBox:
    """A box of any of the six, closed."""
    box = draw_box(rng, list(KINDS)[int(rng.integers(len(KINDS)))])
    return _as(msgspec.structs.replace(box, flaps=(None, None, None, None), is_closed=True), category, variant)


def _with_flaps(rng: Rng, categories: tuple[str, ...]) -> OpenBox:
    """A box of any of these categories that has a flap."""
    while True:
        box = draw_box(rng, categories[int(rng.integers(len(categories)))])
        if any(box.flaps):
            return box


def _as(box: OpenBox, category: str, variant: str) -> OpenBox:
    return msgspec.structs.replace(box, category=category, variant=variant)


FURTHER_KINDS: dict[str, dict[str, Draw]] = {
    "tote": {"bin": half_slotted, "lipped": lipped},
    "upright": {"set_up": upright},
    "part_shut": {"closing": closing},
    LYING: {"on_its_side": on_its_side},
    "closed": {"sealed": sealed},
}
"""Drawn only where their category is named: the six above go round in sets whose frames stay what they were."""
RARE = {"half_slotted": 0.4, "plain_lid": 0.5}
"""How often these are drawn, against 1 for the others."""


def draw_box(rng: Rng, category: str, variant: str | None = None) -> OpenBox:
    """A box of a category, of the variant if one is named, before its flaps are freed from one another."""
    kinds = (KINDS | FURTHER_KINDS)[category]
    weights = np.array([RARE.get(name, 1.0) for name in kinds])
    name = variant or list(kinds)[int(rng.choice(len(kinds), p=weights / weights.sum()))]
    return kinds[name](rng, category, name)
