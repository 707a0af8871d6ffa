"""What `simulate` says (`simulation.json`, docs/formats.md): what physics made of a plan.

Metres, radians, seconds, newtons. Keys that are not known are ignored when read. Values are checked when made; each
check raises ValueError with one line.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.checks import require_finite, require_name, require_not_negative, require_positive


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


class Simulation(msgspec.Struct, frozen=True, kw_only=True):
    """A run of a plan in physics, against the `inferred` model of a box or the `true` one.

    `box_slid_m` and `box_turned_rad` are the box's way and turn from start to end. `max_force_n` is the most that the
    tool pressed on anything, felt with a time constant of 10 ms. `unwanted` holds the pairs of bodies that touched and
    should not have: of the arm's with anything but the flap that was pushed. `failure` says why the run proves nothing,
    None where it does; where it is told no flap counts as closed. `mass_kg` is that of the box with its contents, which
    weigh `contents_kg`.
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
