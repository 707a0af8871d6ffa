"""A box under a tool in physics, trajectory by trajectory. Physics knows the true box, not what a planner thinks."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any, Literal

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.box_bodies import contents_volume_m3, empty_mass_kg
from boxwright.simulation.physics.commands import course_of, held
from boxwright.simulation.physics.creases import Crease
from boxwright.simulation.physics.judging import closed_boards
from boxwright.simulation.physics.moved import box_as_it_stands, way_and_turn
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.stage import NOTHING, Stage
from boxwright.simulation.physics.state import crease_moments_n_m, flap_positions_rad, world_from_body
from boxwright.simulation.physics.watch import Tripped
from boxwright.simulation.physics.world import Tool, build_world
from boxwright.types import FlapVerdict, PlanSegment, Simulation, Stop
from boxwright.types.checks import require_positive

Array = NDArray[np.float64]

HEAVIEST_KG = 1000.0
"""No box that an arm closes weighs more; contacts of heavier ones are not what their settings were chosen for."""


class Load(msgspec.Struct, frozen=True, kw_only=True):
    """What is in the box: nothing, what fills it at the settings' density, or what makes up a mass in all.

    Raises ValueError for a mass that is not above 0 and at most HEAVIEST_KG.
    """

    empty: bool = False
    mass_kg: float | None = None

    def __post_init__(self) -> None:
        if self.mass_kg is not None:
            require_positive("mass_kg", [min(self.mass_kg, HEAVIEST_KG)])
            if self.mass_kg > HEAVIEST_KG:
                raise ValueError(f"mass_kg is {self.mass_kg:g}; box and contents weigh {HEAVIEST_KG:g} kg at most")

    def contents_kg(self, box: BoardBox, settings: PhysicsSettings) -> float:
        """Raises ValueError for a mass below the empty box's."""
        empty_kg = empty_mass_kg(box, settings)
        if self.mass_kg is not None:
            if self.mass_kg < empty_kg:
                raise ValueError(f"mass is {self.mass_kg} kg; the boards alone weigh {empty_kg:.3f} kg")
            return self.mass_kg - empty_kg
        return 0.0 if self.empty else settings.contents_kg_per_m3 * contents_volume_m3(box)


class _Seen(msgspec.Struct):
    """Of a flap that is pushed: its position before, the least on the way, after; and was it closed then?"""

    before_rad: float
    pushed_to_rad: float | None = None
    after_rad: float = 0.0
    closed: bool = False


class Session:
    """Mutable. `follow` trajectories, each from where the last one ended; ask for the verdict, or for the box, between.

    All is in the tool's base frame. At the start the tool stands at `start` (its joints, rad or m) and everything
    comes to rest. After each flap's retreat the tool waits `rest_s`, and the flap is judged.
    """

    def __init__(
        self,
        box: BoardBox,
        tool: Tool,
        start: Array,
        crease: Crease,
        *,
        opening_m: float = 0.0,
        settings: PhysicsSettings | None = None,
        load: Load | None = None,
        others: Sequence[BoardBox] = (),
        scene: Sequence[Mapping[str, Any]] = (),
        stills_per_s: float = 0.0,
    ) -> None:
        self._began = time.perf_counter()
        self.settings = settings or PhysicsSettings()
        self.box, self._tool = box, tool
        self._contents_kg = (load or Load()).contents_kg(box, self.settings)
        world = build_world(
            box, crease, self.settings, others=others, scene=scene, tool=(tool, start, opening_m),
            contents_kg=self._contents_kg,
        )  # fmt: skip
        self.stage = Stage(world, box, stills_per_s)
        self._place, self._opening_m = start, opening_m
        self._seen: dict[str, _Seen] = {}
        self.warnings: list[str] = []
        self.stopped: Stop | None = None
        self._settle()
        self._first = world_from_body(world, self.stage.data, world.box.root)
        self._before = flap_positions_rad(world, self.stage.data)

    def follow(self, segments: Sequence[PlanSegment]) -> None:
        """One segment after the other, in the tool's joints; flaps are judged as the arm is done with them.

        A flap that this box does not have is told in `warnings`; the tool moves all the same. A tool that pressed too
        hard is stopped there, and follows nothing any more; nor does anything go on where physics came apart.
        """
        for number, segment in enumerate(segments):
            if self.ended is not None:
                return
            self._follow_one(segment)
            after = segments[number + 1].flap if number + 1 < len(segments) else None
            if self.stage.watch.tripped is not None:
                self._stop(self.stage.watch.tripped, segment.flap)
            elif segment.flap is not None and segment.flap != after:
                self._rest()
                self._judge(segment.flap)
        if segments and segments[-1].flap is None and self.ended is None:
            self._rest()

    @property
    def ended(self) -> str | None:
        """Why nothing is followed any more, in one line: the arm was stopped, or physics came apart. None otherwise."""
        if self.stage.apart_at_s is not None:
            return self._failure()
        return None if self.stopped is None else self.stopped.line()

    def box_now(self) -> BoardBox:
        """The box as it stands now: moved, its flaps at their positions."""
        return box_as_it_stands(self.stage.world, self.stage.data, self.box)

    def verdict(self, crease: str, kind: Literal["inferred", "true"]) -> Simulation:
        """What has become of the box; `crease` and `kind` are the names under which that is told."""
        stage, settings = self.stage, self.settings
        slid_m, turned_rad = way_and_turn(
            self._first, world_from_body(stage.world, stage.data, stage.world.box.root), self.box.up
        )
        failure = self._failure()
        told = (f"MuJoCo warns: {' '.join(line.split())}" for line in dict.fromkeys(stage.said) if failure is None)
        return Simulation(
            format="boxwright.simulation",
            version=1,
            robot=self._tool.name,
            box=kind,
            crease=crease,
            mass_kg=empty_mass_kg(self.box, settings) + self._contents_kg,
            contents_kg=self._contents_kg,
            time_step_s=settings.time_step_s,
            flaps=self._verdicts(proven=failure is None),
            box_slid_m=slid_m,
            box_turned_rad=turned_rad,
            max_force_n=stage.watch.max_force_n,
            max_penetration_m=stage.watch.max_penetration_m,
            max_joint_error_rad=stage.max_joint_error_rad,
            unwanted=stage.watch.unwanted(),
            failure=failure,
            warnings=(*self.warnings, *told),
            simulated_s=stage.time_s,
            seconds=time.perf_counter() - self._began,
            stopped=self.stopped,
        )

    def _settle(self) -> None:
        """Everything comes to rest before anything is measured; tells of boards that began inside one another."""
        watch, settings = self.stage.watch, self.settings
        self.stage.caption = "at rest"
        self.stage.follow(held(self._place, settings.time_step_s, settings.time_step_s), self._opening_m)
        deep_m, pair = watch.max_penetration_m, watch.deepest
        self.stage.follow(held(self._place, settings.settle_s, settings.time_step_s), self._opening_m)
        watch.forget_depth()
        if deep_m > settings.tripped_m and pair is not None:
            self.warnings.append(f"{pair[0]} and {pair[1]} began {1000.0 * deep_m:.1f} mm inside one another")

    def _follow_one(self, segment: PlanSegment) -> None:
        stage, flap = self.stage, segment.flap
        stage.caption = f"{segment.kind} {flap or ''}".strip()
        self._place, self._opening_m = np.array(segment.positions[-1]), segment.gripper_opening_m
        course = course_of(segment, self.settings.time_step_s)
        if flap is None or not self._knows(flap):
            stage.follow(course, self._opening_m)
            return
        if flap not in self._seen:
            self._seen[flap] = _Seen(flap_positions_rad(stage.world, stage.data)[flap])
        least_rad = stage.follow(course, self._opening_m, self._allowed(flap), flap)
        if segment.kind == "push" and np.isfinite(least_rad):
            before_rad = self._seen[flap].pushed_to_rad
            self._seen[flap].pushed_to_rad = least_rad if before_rad is None else min(before_rad, least_rad)

    def _stop(self, tripped: Tripped, flap: str | None) -> None:
        """The tool stays where it is, pressing on what it presses on."""
        self.stopped = Stop(
            flap=flap,
            pair=tripped.pair,
            at_m=tripped.at_m,
            at_s=tripped.at_s,
            force_n=tripped.force_n,
            limit_n=self.settings.most_force_n,
        )
        self._place = self.stage.tool_positions()
        is_known = flap is not None and flap in self.stage.world.box.joint_of
        self._rest(self._allowed(flap) if flap is not None and is_known else NOTHING)
        if flap is not None:
            self._judge(flap)

    def _knows(self, flap: str) -> bool:
        known = flap in self.stage.world.box.joint_of
        warning = f"{flap} is pushed, and this box has no such flap"
        if not known and warning not in self.warnings:
            self.warnings.append(warning)
        return known

    def _allowed(self, flap: str) -> frozenset[int]:
        """The gripper may touch the flap that is pushed and what hangs on it, nothing else of the arm anything."""
        world = self.stage.world
        hanging = [board.name for board, hinge in self.box.hinged if hinge.parent == flap]
        bodies = [world.box.body_of[name] for name in (flap, *hanging)]
        pushing = world.tool.pushing if world.tool else ()
        return frozenset(self.stage.watch.code_of(tool, body) for tool in pushing for body in bodies)

    def _rest(self, allowed: frozenset[int] = NOTHING) -> None:
        self.stage.caption = "resting"
        still = held(self._place, self.settings.rest_s, self.settings.time_step_s)
        self.stage.follow(still, self._opening_m, allowed)

    def _judge(self, flap: str) -> None:
        if flap in self._seen:
            stage = self.stage
            self._seen[flap].after_rad = flap_positions_rad(stage.world, stage.data)[flap]
            self._seen[flap].closed = flap in closed_boards(stage.world, stage.data, self.box)

    def _verdicts(self, *, proven: bool) -> dict[str, FlapVerdict]:
        stage = self.stage
        end = flap_positions_rad(stage.world, stage.data)
        closed, moments = closed_boards(stage.world, stage.data, self.box), crease_moments_n_m(stage.world)
        verdicts = {}
        for name in sorted(end):
            seen = self._seen.get(name)
            was_closed = name in closed if seen is None else seen.closed
            # The arm has not left the flap at which it was stopped.
            left = proven and (self.stopped is None or self.stopped.flap != name)
            verdicts[name] = FlapVerdict(
                before_rad=self._before[name] if seen is None else seen.before_rad,
                pushed_to_rad=None if seen is None else seen.pushed_to_rad,
                after_rad=end[name] if seen is None else seen.after_rad,
                end_rad=end[name],
                closed=left and was_closed,
                held=left and name in closed,
                crease_n_m=moments[name],
            )
        return verdicts

    def _failure(self) -> str | None:
        deep_m, pair = self.stage.watch.max_penetration_m, self.stage.watch.deepest
        worst_m = self.settings.worst_penetration_m
        if self.stage.apart_at_s is not None:
            return f"physics came apart at {self.stage.apart_at_s:.2f} s: a position or speed is not finite, or huge"
        if deep_m > worst_m and pair is not None:
            return f"{pair[0]} sank {1e3 * deep_m:.2f} mm into {pair[1]}; more than {1e3 * worst_m:g} mm proves nothing"
        return None
