"""A small plan.json with every kind of segment, as JSON data."""

from __future__ import annotations

import copy
from typing import Any

_IDENTITY = [[1.0, 0.0, 0.0, 0.5], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.1], [0.0, 0.0, 0.0, 1.0]]


def _segment(flap: str | None, kind: str, start: int) -> dict[str, Any]:
    """Three samples a tenth of a second apart of an arm with two joints that turn evenly."""
    steps = range(start, start + 3)
    segment: dict[str, Any] = {
        "flap": flap,
        "kind": kind,
        "times": [0.1 * k for k in steps],
        "positions": [[0.05 * k, -0.02 * k] for k in steps],
        "velocities": [[0.5, -0.2] for _ in steps],
        "gripper_opening_m": 0.0,
        "hinge_angle_rad": None,
        "contact": None,
    }
    if kind == "push":
        segment["hinge_angle_rad"] = [2.0 - 0.1 * k for k in steps]
        segment["contact"] = [[0.5, 0.01 * k, 0.3] for k in steps]
    return segment


_SAMPLE: dict[str, Any] = {
    "format": "boxwright.plan",
    "version": 1,
    "robot": "viper_s850",
    "base_from_input": _IDENTITY,
    "joint_names": ["joint_1", "joint_2"],
    "order": ["flap_1"],
    "flaps": {
        "flap_0": {"status": "joint_limit", "reason": "joint_5 would pass 120 degrees", "seconds": 0.01},
        "flap_1": {"status": "planned", "reason": None, "seconds": 0.02},
        "flap_2": {"status": "already_closed", "reason": "stands at 3.0 degrees", "seconds": 0.0},
        "flap_3": {
            "status": "unreachable",
            "reason": "no pose of the arm reaches it",
            "seconds": 0.0,
            "move": {"x_m": 0.05, "y_m": 0.0, "z_m": 0.0, "yaw_rad": 0.0},
        },
    },
    "segments": [
        _segment(None, "transit", 0),
        _segment("flap_1", "approach", 2),
        _segment("flap_1", "push", 4),
        _segment("flap_1", "retreat", 6),
    ],
}


def sample_plan() -> dict[str, Any]:
    """A fresh copy."""
    return copy.deepcopy(_SAMPLE)
