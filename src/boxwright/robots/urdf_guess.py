"""What a URDF does not tell and a plan needs: which links may touch, and where the arm waits. Both are found by asking.

The core's collision check is asked over fixed postures, spread evenly over the joints' ranges: the same each time.
"""

from __future__ import annotations

import itertools

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.robots.robot_toml import toml_text
from boxwright.types import RobotFile

Array = NDArray[np.float64]

POSTURES = 200

CLEARANCE_M = 0.005
"""The planner's, to itself too (docs/planning.md)."""

OFTEN = 0.5
"""Links that come nearer in so many of the postures are drawn too thick to be held against each other.

Of the shipped arms pairs that are no neighbours do in 86 % and more of them, or in 7 % and less.
"""

SHOULDER = 2
"""Joint 2's frame, after the base's and joint 1's: what it carries waits above it, out of the way of boxes."""


def middle_deg(file: RobotFile) -> tuple[float, ...]:
    """The middle of each joint's range."""
    return tuple((lower + upper) / 2.0 for lower, upper in (joint.limits_deg for joint in file.joint))


def touching_pairs(file: RobotFile) -> tuple[tuple[str, str], ...]:
    """Pairs of links, gripper and fingers among them, that `OFTEN` come nearer than the clearance; no neighbours."""
    bare = msgspec.structs.replace(file, may_touch=())
    arm = _core.Arm(toml_text(bare))
    postures = _postures_rad(arm.limits)
    pairs = list(itertools.combinations(arm.body_names, 2))
    # One pair at a time is held against each other: all others may touch.
    alone = [(pair, tuple(other for other in pairs if other != pair)) for pair in pairs]
    return tuple(
        pair
        for pair, others in alone
        if _clear(msgspec.structs.replace(bare, may_touch=others), postures).mean() <= 1.0 - OFTEN
    )


def free_ready_deg(file: RobotFile) -> tuple[float, ...] | None:
    """The posture nearest to the middle of the limits that is clear of the arm itself, all above its shoulder.

    Where none is above it, the nearest that is clear; None where none is clear.
    """
    arm = _core.Arm(toml_text(file))
    middle, half = arm.limits.mean(axis=1), np.ptp(arm.limits, axis=1) / 2.0
    postures = np.vstack([middle, _postures_rad(arm.limits)])
    nearest = np.argsort(np.linalg.norm((postures - middle) / half, axis=1), kind="stable")
    # Whole degrees are easier to read and to set right; half a degree more or less decides nothing.
    rounded_deg = np.round(np.degrees(postures[nearest]))
    degrees = np.clip(rounded_deg, *np.array([joint.limits_deg for joint in file.joint]).T)
    clear = _clear(file, np.radians(degrees))
    above = clear & np.array([_is_above_shoulder(arm, posture) for posture in np.radians(degrees)])
    for fits in (above, clear):
        if fits.any():
            return tuple(float(angle) + 0.0 for angle in degrees[int(np.argmax(fits))])
    return None


def _clear(file: RobotFile, postures_rad: Array) -> NDArray[np.bool_]:
    """(N,) whether the arm is clear of itself, its gripper closed and wide open."""
    arm = _core.Arm(toml_text(file))
    ways = [_core.Clearance(arm, _core.World(), CLEARANCE_M, opening_m) for opening_m in file.gripper.opening_m]
    return np.asarray(np.all([way.is_clear(postures_rad) for way in ways], axis=0), np.bool_)


def _is_above_shoulder(arm: _core.Arm, posture_rad: Array) -> bool:
    heights_m = arm.link_frames(posture_rad)[SHOULDER:, 2, 3]
    tool_m = arm.forward(posture_rad[None])[0, 2, 3]
    return bool(min(heights_m[1:].min(), tool_m) >= heights_m[0])


def _postures_rad(limits_rad: Array) -> Array:
    """(POSTURES, axes): steps of irrational shares, which fill the joints' ranges evenly.

    M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018: powers of 1 / g, g^(axes + 1) = g + 1.
    """
    axes = len(limits_rad)
    golden = 2.0
    for _ in range(64):
        golden = (1.0 + golden) ** (1.0 / (axes + 1))
    shares = (0.5 + np.outer(np.arange(1, POSTURES + 1), golden ** -np.arange(1.0, axes + 1))) % 1.0
    lower, upper = limits_rad.T
    return np.asarray(lower + shares * (upper - lower), np.float64)
