"""The planner's timing against toppra, by the algorithm's authors: no faster than limits allow, and not much slower.

It is slower because the whole motion is slowed until every millisecond of it keeps the limits; toppra's own does not.
"""

from __future__ import annotations

import numpy as np
import pytest
import toppra
from toppra import algorithm, constraint

from boxwright import _core

SPEEDS = np.array([4.0, 4.0, 4.0, 6.0, 6.0, 10.0])
ACCELERATIONS = np.array([17.0, 17.0, 17.0, 26.0, 26.0, 40.0])
SLOWER = 1.35


def _way(seed: int) -> np.ndarray:
    """A smooth way of six joints, 80 postures."""
    rng = np.random.default_rng(seed)
    share = np.linspace(0.0, 1.0, 80)[:, None]
    waves = sum(rng.normal(0.0, 0.6 / k, 6) * np.sin(np.pi * k * share + rng.uniform(0.0, 6.0, 6)) for k in (1, 2, 3))
    return np.asarray(waves)


def _by_toppra(way: np.ndarray) -> float:
    toppra.setup_logging("WARNING")
    turns = np.abs(np.diff(way, axis=0)).max(axis=1)
    path = toppra.SplineInterpolator(np.concatenate([[0.0], np.cumsum(turns)]), way, bc_type="natural")
    limits = [
        constraint.JointVelocityConstraint(np.stack([-SPEEDS, SPEEDS], axis=1)),
        constraint.JointAccelerationConstraint(np.stack([-ACCELERATIONS, ACCELERATIONS], axis=1)),
    ]
    grid = np.linspace(0.0, path.duration, 400)
    solver = algorithm.TOPPRA(limits, path, gridpoints=grid, parametrizer="ParametrizeConstAccel")
    return float(solver.compute_trajectory(0.0, 0.0).duration)


def test_durations_agree_with_toppra() -> None:
    compared = 0
    for seed in range(12):
        way = _way(seed)
        times, _, _ = _core.time_way(way, SPEEDS.tolist(), ACCELERATIONS.tolist(), 0.004)
        oracle_s = _by_toppra(way)
        assert oracle_s * 0.99 <= times[-1] <= oracle_s * SLOWER, f"way {seed}: {times[-1]} against {oracle_s} s"
        compared += 1
    assert compared == 12


def test_what_is_no_way_is_refused() -> None:
    with pytest.raises(ValueError, match="one posture only"):
        _core.time_way(np.zeros((3, 6)), SPEEDS.tolist(), ACCELERATIONS.tolist(), 0.01)
    with pytest.raises(ValueError, match="an acceleration for each axis"):
        _core.time_way(np.zeros((3, 5)), SPEEDS.tolist(), ACCELERATIONS.tolist(), 0.01)
