"""How boxes stand on their way from set up to closed: their flaps turned to where a packer leaves them."""

from __future__ import annotations

import msgspec
import numpy as np

from boxwright.simulation.boxes import Flap, OpenBox

Rng = np.random.Generator

LYING = "lying"
"""The category of boxes that do not stand on their base."""
SLOTS_M = (0.0015, 0.006)
"""From a corner to the end of a flap that stands up: half a slot."""
UNDER_M = 0.004
"""Flaps that go under others are slotted wider by this much."""
UPRIGHT_DEG = (90.0, 1.5)
"""Mean and standard deviation."""
UNDER_DEG, OVER_DEG = (-3.0, 0.5), (0.0, 5.0)
"""Flaps that are shut: those below, and those over them."""
OPEN_DEG = (60.0, 230.0)


def set_up(rng: Rng, box: OpenBox) -> OpenBox:
    """All flaps in their sides' planes, nothing but slots between them."""

    def stood(flap: Flap) -> Flap:
        return _turned(flap, rng.normal(*UPRIGHT_DEG), float(rng.uniform(*SLOTS_M)))

    return _with(box, [None if flap is None else stood(flap) for flap in box.flaps])


def part_shut(rng: Rng, box: OpenBox) -> OpenBox:
    """Some flaps shut, the smaller first, one at least well open. One flap alone is open."""
    area = {k: (box.length_m, box.width_m)[k % 2] * flap.length_m for k, flap in enumerate(box.flaps) if flap}
    by_area = sorted(area, key=lambda k: area[k])
    shut = by_area[: int(rng.integers(1, len(by_area)))] if len(by_area) > 1 else []

    def turned(k: int, flap: Flap) -> Flap:
        if k not in shut:
            return _turned(flap, rng.uniform(*OPEN_DEG), flap.inset_m, flap.bend_rad)
        if k in by_area[:2]:
            return _turned(flap, rng.uniform(*UNDER_DEG), flap.inset_m + UNDER_M)
        return _turned(flap, rng.uniform(*OVER_DEG), flap.inset_m)

    return _with(box, [None if flap is None else turned(k, flap) for k, flap in enumerate(box.flaps)])


def _turned(flap: Flap, angle_deg: float, inset_m: float, bend_rad: float = 0.0) -> Flap:
    angle_rad = float(np.radians(angle_deg))
    return msgspec.structs.replace(flap, angle_rad=angle_rad, inset_m=inset_m, bend_rad=bend_rad)


def _with(box: OpenBox, flaps: list[Flap | None]) -> OpenBox:
    first, second, third, fourth = flaps
    return msgspec.structs.replace(box, flaps=(first, second, third, fourth))
