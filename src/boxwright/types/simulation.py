"""What `simulate` says (`simulation.json`, docs/formats.md): what physics made of a plan.

Metres, radians, seconds, newtons. Keys that are not known are ignored when read. Values are checked when made; each
check raises ValueError with one line.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.checks import require_finite, require_name, require_not_negative, require_positive
from boxwright.types.truth import Vector


class FlapVerdict(msgspec.Struct, frozen=True, kw_only=True):
    """What became of a flap.

    `before_rad` is its position before the arm came to it, `pushed_to_rad` the least while it was pushed (None where it
    was not), `after_rad` that after the arm had retreated and everything had rested, and `end_rad` that at the end of
    all. `closed` is judged with `after_rad` and `held` at the end, when others may hold it down or have swept it open;
    a flap that was not pushed is judged at the end alone. `crease_n_m` is the moment that folds its whole crease on.
    """

    before_rad: float
    pushed_to_rad: float | None
    after_rad: float
    end_rad: float
    closed: bool
    held: bool
    crease_n_m: float

    def __post_init__(self) -> None:
        require_finite("flaps", [self.before_rad, self.pushed_to_rad or 0.0, self.after_rad, self.end_rad])
        require_positive("crease_n_m", [self.crease_n_m])


class Stop(msgspec.Struct, frozen=True, kw_only=True):
    """Where the arm was stopped since it pressed on something with more than `limit_n`; nothing was done after it.

    `flap` was being closed, None on a way between flaps; `pair` are the arm's body and what it pressed on hardest, at
    `at_m` in the robot's base frame, `at_s` after the run's start. `force_n` is felt as `max_force_n` is.
    """

    flap: str | None
    pair: tuple[str, str]
    at_m: Vector
    at_s: float
    force_n: float
    limit_n: float

    def __post_init__(self) -> None:
        require_finite("at_m", self.at_m)
        require_positive("stopped", [self.at_s, self.limit_n, self.force_n])

    def line(self) -> str:
        """In one line."""
        doing = f"closing {self.flap}" if self.flap else "between flaps"
        where = ", ".join(f"{value:.3f}" for value in self.at_m)
        return (
            f"stopped at {self.at_s:.1f} s, {doing}: {self.pair[0]} pressed {self.pair[1]} at ({where}) m, "
            f"{self.force_n:.0f} N in all; more than {self.limit_n:g} N stops the arm"
        )


class Simulation(msgspec.Struct, frozen=True, kw_only=True):
    """A run of a plan in physics, against the `inferred` model of a box or the `true` one.

    `box_slid_m` and `box_turned_rad` are the box's way and turn from start to end. `max_force_n` is the most that the
    tool pressed on anything, felt with a time constant of 10 ms. `unwanted` holds the pairs of bodies that touched and
    should not have: of the arm's with anything but the flap that was pushed. `failure` says why the run proves nothing,
    None where it does; where it is told no flap counts as closed. `stopped` says where the arm was stopped for pressing
    too hard, None where it came to the plan's end; the flap that it was about is not closed, as the arm has not left
    it, the others are judged as they are then. `mass_kg` is that of the box with its contents, which weigh
    `contents_kg`.
    """

    format: Literal["boxwright.simulation"]
    version: Literal[1]
    robot: str
    box: Literal["inferred", "true"]
    crease: str
    mass_kg: float
    contents_kg: float
    time_step_s: float
    flaps: dict[str, FlapVerdict]
    box_slid_m: float
    box_turned_rad: float
    max_force_n: float
    max_penetration_m: float
    max_joint_error_rad: float
    """The farthest that a joint of the arm was from where the plan has it."""
    unwanted: tuple[tuple[str, str], ...]
    failure: str | None
    warnings: tuple[str, ...]
    simulated_s: float
    seconds: float
    """Time that the run took."""
    stopped: Stop | None = None

    def __post_init__(self) -> None:
        require_name("robot", self.robot)
        require_positive("mass_kg", [self.mass_kg])
        require_positive("time_step_s", [self.time_step_s])
        for name in (
            "contents_kg",
            "box_slid_m",
            "box_turned_rad",
            "max_force_n",
            "max_penetration_m",
            "max_joint_error_rad",
        ):
            require_not_negative(name, [getattr(self, name)])
        require_not_negative("simulated_s", [self.simulated_s])
        require_not_negative("seconds", [self.seconds])
        if self.failure is not None and any(flap.closed or flap.held for flap in self.flaps.values()):
            raise ValueError("failure is told and a flap is closed; a run that fails proves nothing")
        about = None if self.stopped is None else self.flaps.get(self.stopped.flap or "")
        if about is not None and (about.closed or about.held):
            raise ValueError("the arm was stopped at a flap, and that is closed; it has not left it")
