"""One question to the core's planner."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any

from boxwright import _core
from boxwright.robots import robot_text


def ask(
    robot: str | PathLike[str],
    box: Mapping[str, Any],
    settings: Mapping[str, Any] | None = None,
    *,
    scene: Sequence[Mapping[str, Any]] = (),
    method: str = "layered",
    only: Sequence[str] = (),
    closed: Sequence[str] = (),
    quick: bool = False,
) -> dict[str, Any]:
    """The core's answer about a box in the base frame: order, flaps, segments, joint_names, robot.

    `only` leaves all other flaps as they are; `closed` flaps are taken to have been closed before;
    `quick` makes the first of the searches alone. Raises ValueError in
    one line for what cannot be used.
    """
    request = {
        "box": box,
        "scene": list(scene),
        "method": method,
        "settings": dict(settings or {}),
        "only": list(only),
        "closed": list(closed),
        "quick": quick,
    }
    answer: dict[str, Any] = json.loads(_core.plan_closing(robot_text(robot), json.dumps(request)))
    return answer


def ask_feasible(robot: str | PathLike[str], box: Mapping[str, Any], only: Sequence[str]) -> dict[str, bool]:
    """Of the named flaps that are open: can brute force close each by itself, all others as they are? Takes minutes."""
    return dict(_core.feasible_flaps(robot_text(robot), json.dumps({"box": box, "only": list(only)})))


def ask_bearable(box: Mapping[str, Any], settings: Mapping[str, Any] | None = None) -> dict[str, bool]:
    """Of the open flaps: does the box, as its folds and weight are assumed, stand being pushed so hard?"""
    return dict(_core.bearable_flaps(json.dumps({"box": box, "settings": dict(settings or {})})))
