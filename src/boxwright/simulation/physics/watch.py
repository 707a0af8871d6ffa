"""What is watched at every time step: how deep things sink into each other, who touches whom, how hard."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.world import World

Array = NDArray[np.float64]

FELT_S = 0.01
"""Forces are told as a sensor of this time constant feels them: how high the peak of a stiff impact is, the time step
decides."""


class Tripped(msgspec.Struct, frozen=True):
    """When the tool first pressed too hard (s), how hard as felt (N), with which body on which, and where (m)."""

    at_s: float
    force_n: float
    pair: tuple[str, str]
    at_m: tuple[float, float, float]


class Watch:
    """The worst of a run so far. `note` after every step; it reads the contacts of that step and changes nothing."""

    def __init__(self, world: World) -> None:
        model = world.model
        self._model = model
        self._bodies = model.nbody
        self._body_of_geom = model.geom_bodyid
        self._is_tool = np.zeros(model.nbody, dtype=bool)
        for name in world.tool.bodies if world.tool else ():
            self._is_tool[model.body(name).id] = True
        self._is_tool_geom = self._is_tool[model.geom_bodyid]
        self.max_penetration_m = 0.0
        self.deepest: tuple[str, str] | None = None
        self.max_force_n = 0.0
        self.tripped: Tripped | None = None
        self._limit_n = world.settings.most_force_n
        self._felt_n = 0.0
        self._share = min(1.0, world.settings.time_step_s / FELT_S)
        self._touched: set[int] = set()

    def note(self, data: mujoco.MjData, allowed: frozenset[int]) -> None:
        """`allowed` holds the codes (`code_of`) of pairs of a tool's and another body that may touch now."""
        force_n = self._look(data, allowed) if data.ncon else 0.0
        self._felt_n += self._share * (force_n - self._felt_n)
        self.max_force_n = max(self.max_force_n, self._felt_n)
        if self.tripped is None and self._felt_n > self._limit_n:
            self.tripped = self._trip(data)

    def _look(self, data: mujoco.MjData, allowed: frozenset[int]) -> float:
        """Notes depths and pairs; the normal force (N) on the tool."""
        contact = data.contact
        geoms, dist = contact.geom, contact.dist
        if -dist.min() > self.max_penetration_m:
            deepest = int(dist.argmin())
            self.max_penetration_m = -float(dist[deepest])
            self.deepest = self._names(*self._body_of_geom[geoms[deepest]])
        is_tool = self._is_tool_geom[geoms]
        if not is_tool.max():
            return 0.0
        tooled = is_tool.any(axis=1)
        pairs = np.sort(self._body_of_geom[geoms[tooled]], axis=1)
        self._touched |= set((pairs[:, 0] * self._bodies + pairs[:, 1]).tolist()) - allowed
        # With an elliptic cone the normal force stands in the first of a contact's rows.
        rows = contact.efc_address[tooled]
        return float(data.efc_force[rows[rows >= 0]].sum())

    def _trip(self, data: mujoco.MjData) -> Tripped:
        """What the tool presses on hardest in the step that passes the limit, in which it touches something."""
        contact = data.contact
        forces_n = np.where(contact.efc_address >= 0, data.efc_force[contact.efc_address], 0.0)
        hardest = int(np.where(self._is_tool_geom[contact.geom].any(axis=1), forces_n, -1.0).argmax())
        x, y, z = (float(value) for value in contact.pos[hardest])
        pair = self._names(*self._body_of_geom[contact.geom[hardest]])
        return Tripped(float(data.time), self._felt_n, pair, (x, y, z))

    def forget_depth(self) -> None:
        """What sank into what until now was not a run's doing."""
        self.max_penetration_m, self.deepest = 0.0, None

    def code_of(self, first: str, second: str) -> int:
        """A number for a pair of bodies, in either order."""
        low, high = sorted((self._model.body(first).id, self._model.body(second).id))
        return int(low * self._bodies + high)

    def unwanted(self) -> tuple[tuple[str, str], ...]:
        """Pairs that touched while they should not, in the order of the bodies' names."""
        return tuple(sorted({self._names(*divmod(code, self._bodies)) for code in self._touched}))

    def _names(self, first: int, second: int) -> tuple[str, str]:
        """The tool's body first, where one of the two is."""
        order = sorted((int(first), int(second)), key=lambda body: not self._is_tool[body])
        return self._model.body(order[0]).name, self._model.body(order[1]).name
