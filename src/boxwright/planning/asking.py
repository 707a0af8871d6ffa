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
) -> dict[str, Any]:
    """The core's answer about a box in the base frame: order, flaps, segments, joint_names, robot.

    `only` leaves all other flaps as they are; `closed` flaps are taken to have been closed before. Raises ValueError in
    one line for what cannot be used.
    """
    request = {
        "box": box,
        "scene": list(scene),
        "method": method,
        "settings": dict(settings or {}),
        "only": list(only),
        "closed": list(closed),
    }
    answer: dict[str, Any] = json.loads(_core.plan_closing(robot_text(robot), json.dumps(request)))
    return answer
