"""Trajectories as what actuators are told at each time step."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.types import PlanSegment

Array = NDArray[np.float64]


class Course(msgspec.Struct, frozen=True, eq=False):
    """Positions, velocities and accelerations (N, J) at the beginning of each of N time steps."""

    positions: Array
    velocities: Array
    accelerations: Array

    def rows(self) -> tuple[Array, Array, Array]:
        """All three."""
        return self.positions, self.velocities, self.accelerations


def course_of(segment: PlanSegment, time_step_s: float) -> Course:
    """A segment's samples, joined by cubics that have its velocities (Hermite); the last step ends when it ends."""
    times, positions, velocities = (np.array(rows) for rows in (segment.times, segment.positions, segment.velocities))
    count = max(1, int(np.ceil((times[-1] - times[0]) / time_step_s - 1e-9)))
    at = times[0] + time_step_s * np.arange(count)
    before = np.clip(np.searchsorted(times, at, side="right") - 1, 0, len(times) - 2)
    span = (times[before + 1] - times[before])[:, None]
    share = (at - times[before])[:, None] / span
    start, end = positions[before], positions[before + 1]
    start_slope, end_slope = span * velocities[before], span * velocities[before + 1]
    step = end - start
    square, cube = 3.0 * step - 2.0 * start_slope - end_slope, start_slope + end_slope - 2.0 * step
    return Course(
        start + share * (start_slope + share * (square + share * cube)),
        (start_slope + share * (2.0 * square + 3.0 * share * cube)) / span,
        (2.0 * square + 6.0 * share * cube) / span**2,
    )


def held(positions: Array, seconds: float, time_step_s: float) -> Course:
    """Standing still at these positions (J,)."""
    count = max(1, round(seconds / time_step_s))
    still = np.zeros((count, len(positions)))
    return Course(np.tile(positions, (count, 1)), still, still)
