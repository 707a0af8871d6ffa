"""A model's object in the robot's base frame, as the core's planner asks for it."""

from __future__ import annotations

from typing import Any

import numpy as np

from boxwright.kinematics.transforms import Matrix, apply
from boxwright.types import Joint, Model, Object, Part
from boxwright.types.board import BOARD_THICKNESS_M

LEAST_FLAP_M = 0.005
"""A flap that is shorter or narrower gives a finger nothing to push: it counts as absent."""

UNDER_M = 0.015
"""A box with a corner of its base so far above the support stands on something."""

LEAST_UNDER_M = 0.005
"""Where the base lies on the support a board under its edge is so high all the same: one of no height is none."""

LEAST_PRESENT = 0.5
"""A part that is less probable than this to be there is absent."""


def measured_box(model: Model, index: int, base_from_input: Matrix) -> dict[str, Any]:
    """Boards, flaps and support around object `index`, metres, the robot's base frame.

    Other objects' boards stand in the way as they are, and so does what a base that leans stands on, which nobody sees:
    all between it and the support. A part is a flap where it hangs on a side, a tuck where it hangs on a flap. Raises
    ValueError where the model has no such object, or where nothing of it turns.
    """
    if not 0 <= index < len(model.objects):
        had = f"it has {len(model.objects)}, counted from 0" if model.objects else "no box was found in it"
        raise ValueError(f"object {index} is not in the model; {had}")
    chosen = model.objects[index]
    flaps = _flaps(chosen, base_from_input)
    if not flaps:
        raise ValueError(f"object {index} ({chosen.template}) has no flaps; only what hangs on a hinge can be closed")
    turning = {joint.child for joint in chosen.joints}
    fixed = _boards(chosen, turning, base_from_input, "")
    for number, other in enumerate(model.objects):
        if number != index:
            fixed += _boards(other, set(), base_from_input, f"object_{number}_")
    support = _support(model, base_from_input)
    return {
        "thickness_m": chosen.thickness or BOARD_THICKNESS_M,
        "fixed": fixed + _under(chosen, support, base_from_input),
        "flaps": flaps,
        "support": support,
    }


def _boards(model_object: Object, left_out: set[str], base_from_input: Matrix, prefix: str) -> list[dict[str, Any]]:
    return [
        {"name": f"{prefix}{part.name}", "corners": _corners(part, base_from_input)}
        for part in model_object.parts
        if part.corners is not None and part.name not in left_out
    ]


def _under(
    model_object: Object, support: tuple[list[float], float] | None, base_from_input: Matrix
) -> list[dict[str, Any]]:
    """Upright boards from the edges of a base that leans down to the support: there is no way under it."""
    base = next((part for part in model_object.parts if part.name == "base" and part.corners is not None), None)
    if base is None or support is None:
        return []
    up, corners = np.array(support[0]), np.array(_corners(base, base_from_input))
    heights_m = corners @ up - support[1]
    if heights_m.max() < UNDER_M:
        return []
    feet = corners - np.maximum(heights_m, LEAST_UNDER_M)[:, None] * up
    around = [(k, (k + 1) % len(corners)) for k in range(len(corners))]
    return [
        {
            "name": "what it stands on",
            "corners": [corners[i].tolist(), corners[j].tolist(), feet[j].tolist(), feet[i].tolist()],
        }
        for i, j in around
    ]


def _flaps(model_object: Object, base_from_input: Matrix) -> list[dict[str, Any]]:
    """Flaps in the order of their names: those with a hinge, and those that the template has and nobody saw."""
    joint_of = {joint.child: joint for joint in model_object.joints}
    found = []
    for part in sorted(model_object.parts, key=lambda part: part.name):
        joint = joint_of.get(part.name)
        if joint is not None and joint.parent in joint_of:
            continue
        if joint is None and not part.name.startswith("flap_"):
            continue
        found.append(_flap(part, joint, model_object, base_from_input))
    return found if joint_of else []


def _flap(part: Part, joint: Joint | None, model_object: Object, base_from_input: Matrix) -> dict[str, Any]:
    flap: dict[str, Any] = {
        "name": part.name,
        "side": part.name.replace("flap", "side") if joint is None else joint.parent,
        "standing": "absent" if _is_stub(part, joint) else _standing(part, joint),
        "corners": None if joint is None else _corners(part, base_from_input),
        "origin": [0.0, 0.0, 0.0],
        "axis": [1.0, 0.0, 0.0],
        "position_rad": 0.0,
    }
    if joint is not None:
        flap["origin"] = apply(base_from_input, np.array([joint.origin]))[0].tolist()
        flap["axis"] = (base_from_input[:3, :3] @ np.array(joint.axis)).tolist()
        flap["position_rad"] = joint.position
        children = {other.child for other in model_object.joints if other.parent == part.name}
        flap["tucks"] = _boards(
            model_object, {other.name for other in model_object.parts} - children, base_from_input, ""
        )
    return flap


def _is_stub(part: Part, joint: Joint | None) -> bool:
    """A flap that was fitted to have next to no length."""
    if joint is None or part.corners is None:
        return False
    corners, axis = np.array(part.corners), np.array(joint.axis)
    reach = corners[2:].mean(axis=0) - corners[:2].mean(axis=0)
    width_m = float(np.linalg.norm(corners[1] - corners[0]))
    return min(float(np.linalg.norm(reach - (reach @ axis) * axis)), width_m) < LEAST_FLAP_M


def _standing(part: Part, joint: Joint | None) -> str:
    present = 1.0 if part.state is None else part.state.seen + part.state.hidden
    if joint is None:
        return "absent" if part.corners is None and (part.state is None or present < LEAST_PRESENT) else "hidden"
    if part.observed:
        return "seen"
    return "hidden" if present >= LEAST_PRESENT else "absent"


def _support(model: Model, base_from_input: Matrix) -> tuple[list[float], float] | None:
    if model.support_plane is None:
        return None
    normal = base_from_input[:3, :3] @ np.array(model.support_plane.normal)
    return normal.tolist(), float(model.support_plane.distance + normal @ base_from_input[:3, 3])


def _corners(part: Part, base_from_input: Matrix) -> list[list[float]]:
    corners: list[list[float]] = apply(base_from_input, np.array(part.corners)).tolist()
    return corners
