"""A world in motion: steps it along courses, watches every step, keeps what a film needs."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.commands import Course
from boxwright.simulation.physics.layers import Layers
from boxwright.simulation.physics.quiet import heard_warnings
from boxwright.simulation.physics.state import standing_state
from boxwright.simulation.physics.watch import Watch
from boxwright.simulation.physics.world import Tool, World

Array = NDArray[np.float64]

LAYERS_S = 0.01
"""How often it is looked at which flaps have come down: none gets far in this time."""

NOTHING: frozenset[int] = frozenset()

CAME_APART = slice(mujoco.mjtWarning.mjWARN_BADQPOS.value, mujoco.mjtWarning.mjNWARNING.value)
"""Of MuJoCo's warnings those after which it starts anew: something of the state is not finite, or huge."""


class Film(msgspec.Struct, frozen=True, eq=False):
    """What pictures are drawn from: each still's time (s), joint positions (nq,) of all that moves, and caption."""

    times: list[float]
    positions: list[Array]
    captions: list[str]


class Stage:
    """Mutable: `data` is the state now, `watch` the worst until now, `film` a still every so often.

    Where the state is no longer finite nothing moves any more: `apart_at_s` is when, `data` has the positions before.
    `said` is what MuJoCo warned of.
    """

    def __init__(self, world: World, box: BoardBox, stills_per_s: float = 0.0) -> None:
        self.world = world
        with heard_warnings() as self.said:
            self.data = standing_state(world)
        self.apart_at_s: float | None = None
        self.watch = Watch(world)
        self._layers = Layers(world, box, self.data)
        self._layers_every = max(1, round(LAYERS_S / world.settings.time_step_s))
        self.film = Film([], [], [])
        self.caption = ""
        self.max_joint_error_rad = 0.0
        self._tool: Tool | None = world.start[0] if world.start else None
        self._every = max(1, round(1.0 / (stills_per_s * world.settings.time_step_s))) if stills_per_s > 0 else 0
        self._steps = 0
        model = world.model
        names = world.tool.joints if world.tool else ()
        self._joints = np.array([model.joint(name).qposadr[0] for name in names], dtype=int)
        self._warned = self.data.warning.number

    @property
    def time_s(self) -> float:
        """How long things have moved."""
        return float(self.data.time) if self.apart_at_s is None else self.apart_at_s

    def follow(
        self, course: Course, opening_m: float = 0.0, allowed: frozenset[int] = NOTHING, flap: str | None = None
    ) -> float:
        """Steps to the course's end; the least position (rad) of a flap on the way, infinite where none is named.

        `allowed` are the pairs that may touch on the way (`Watch.code_of`). Ends early where the tool first presses too
        hard (`watch.tripped`), and where physics comes apart; does nothing where it did before.
        """
        if self.apart_at_s is not None:
            return float("inf")
        with heard_warnings() as said:
            least_rad = self._steps_along(course, opening_m, allowed, flap)
        self.said += said
        return least_rad

    def _steps_along(self, course: Course, opening_m: float, allowed: frozenset[int], flap: str | None) -> float:
        model, data, watch = self.world.model, self.data, self.watch
        flap_at = None if flap is None else int(model.joint(self.world.box.joint_of[flap]).qposadr[0])
        least_rad, was_tripped = np.inf, watch.tripped is not None
        commands = None if self._tool is None else self._tool.commands(*course.rows(), opening_m)
        followed = course.positions.copy()
        for k in range(len(course.positions)):
            if commands is not None:
                data.ctrl[:] = commands[k]
                followed[k] = data.qpos[self._joints]
            if k % self._layers_every == 0:
                self._layers.update(data)
            before, before_s = data.qpos.copy(), float(data.time)
            mujoco.mj_step(model, data)
            if self._warned.any() and self._warned[CAME_APART].any():
                self._come_apart(before, before_s)
                break
            watch.note(data, allowed)
            if flap_at is not None:
                least_rad = min(least_rad, data.qpos[flap_at])
            self._film()
            if watch.tripped is not None and not was_tripped:
                break
        if commands is not None:
            errors = np.abs(followed - course.positions)
            self.max_joint_error_rad = max(self.max_joint_error_rad, float(errors.max(initial=0.0)))
        return float(least_rad)

    def _come_apart(self, positions: Array, at_s: float) -> None:
        """MuJoCo has put everything back to where it began: as it stood last is what can be told."""
        self.apart_at_s = at_s
        self.data.qpos[:] = positions
        mujoco.mj_kinematics(self.world.model, self.data)

    def tool_positions(self) -> Array:
        """The tool's joints (rad or m) as they are now."""
        return np.array(self.data.qpos[self._joints])

    def _film(self) -> None:
        if self._every and self._steps % self._every == 0:
            self.film.times.append(float(self.data.time))
            self.film.positions.append(self.data.qpos.copy())
            self.film.captions.append(self.caption)
        self._steps += 1
