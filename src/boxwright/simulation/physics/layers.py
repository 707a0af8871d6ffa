"""Which flap lies over which: of two neighbours the one that came down first is the inner one (sheets.py).

A pair that stood up again after one of them was down stays as it was: what lay over comes down last again.
"""

from __future__ import annotations

import mujoco
import numpy as np

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.sheets import beside_bit, over_bit
from boxwright.simulation.physics.slabs import area_m2
from boxwright.simulation.physics.world import World

DOWN_RAD = float(np.radians(60.0))
"""A flap below this is on its way over the opening."""


class Layers:
    """Mutable: `update` it as flaps move. It switches contacts between sheets in the world's model."""

    def __init__(self, world: World, box: BoardBox, data: mujoco.MjData) -> None:
        self._model = world.model
        flaps = {int(board.name[-1]): board for board, _ in box.hinged if board.name.startswith("flap")}
        self._at = {k: int(world.model.joint(world.box.joint_of[b.name]).qposadr[0]) for k, b in flaps.items()}
        bodies = {k: world.box.body_of[board.name] for k, board in flaps.items()}
        self._outer_geoms = {k: self._geoms_of(body, "outer") for k, body in bodies.items()}
        self._inner_geoms = {k: self._geoms_of(body, "inner") for k, body in bodies.items()}
        self._pairs = [(k, (k + 1) % 4) for k in range(4) if k in flaps and (k + 1) % 4 in flaps]
        self._down = {k: bool(data.qpos[at] < DOWN_RAD) for k, at in self._at.items()}
        for first, second in self._pairs:
            if self._down[first] and self._down[second]:
                # Nothing has moved yet: of two that are down the larger lies over the smaller, as boxes are closed.
                larger_first = area_m2(flaps[first].corners) > area_m2(flaps[second].corners)
                self._lay(*((first, second) if larger_first else (second, first)))
            elif self._down[first] or self._down[second]:
                self._lay(*((second, first) if self._down[first] else (first, second)))
            else:
                self._stand(first, second)

    def update(self, data: mujoco.MjData) -> None:
        """A flap that comes down lies over neighbours that are down already, and under those that are not."""
        for k, at in self._at.items():
            down = bool(data.qpos[at] < DOWN_RAD)
            if down and not self._down[k]:
                for first, second in self._pairs:
                    if k in (first, second):
                        other = second if k == first else first
                        self._lay(*((k, other) if self._down[other] else (other, k)))
            self._down[k] = down

    def _lay(self, over: int, under: int) -> None:
        self._switch(self._outer_geoms[over], over_bit(over, under), on=True)
        self._switch(self._outer_geoms[under], over_bit(under, over), on=False)
        for flap in (over, under):
            self._switch(self._inner_geoms[flap], beside_bit(over, under), on=False)

    def _stand(self, first: int, second: int) -> None:
        self._switch(self._outer_geoms[first], over_bit(first, second), on=False)
        self._switch(self._outer_geoms[second], over_bit(second, first), on=False)

    def _switch(self, geoms: list[int], bit: int, *, on: bool) -> None:
        for geom in geoms:
            kind = int(self._model.geom_contype[geom])
            self._model.geom_contype[geom] = kind | bit if on else kind & ~bit

    def _geoms_of(self, body: str, sheet: str) -> list[int]:
        start, count = int(self._model.body(body).geomadr[0]), int(self._model.body(body).geomnum[0])
        return [k for k in range(start, start + count) if f"_{sheet}_" in self._model.geom(k).name]
