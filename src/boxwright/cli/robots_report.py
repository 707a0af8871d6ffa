"""What `boxwright robots` prints."""

from __future__ import annotations

import json

from boxwright.cli.screen import console, number, table
from boxwright.robots import Robot


def print_list(robots: list[Robot]) -> None:
    """One line for each robot."""
    shown = table("Robots", "name", "axes", "reach m", "payload kg", "inverse")
    for robot in robots:
        axes = str(len(robot.joint_names))
        shown.add_row(robot.name, axes, number(robot.reach_m, 3), number(robot.file.payload_kg), _inverse(robot))
    console().print(shown)


def print_robot(robot: Robot) -> None:
    """A robot's joints, then where its numbers are from."""
    shown = table(
        robot.file.description or robot.name, "joint", "lower deg", "upper deg", "deg/s", "deg/s2", "ready deg"
    )
    for joint, ready_deg in zip(robot.file.joint, robot.file.ready_deg, strict=True):
        values = (*joint.limits_deg, joint.speed_deg_per_s, joint.acceleration_deg_per_s2, ready_deg)
        shown.add_row(joint.name, *(number(value) for value in values))
    out = console()
    out.print(shown)
    out.print(f"reach of the flange from joint 1's axis {robot.reach_m:.3f} m, inverse {_inverse(robot)}")
    for title, lines in (("Sources", robot.file.sources), ("Assumptions", robot.file.assumptions)):
        for line in lines:
            out.print(f"{title}: {line}", markup=False)


def print_json(robots: list[Robot]) -> None:
    """The same for programs: degrees and metres as in the robots' files."""
    print(json.dumps([_as_json(robot) for robot in robots], indent=2))


def _as_json(robot: Robot) -> dict[str, object]:
    return {
        "name": robot.name,
        "description": robot.file.description,
        "axes": len(robot.joint_names),
        "reach_m": round(robot.reach_m, 6),
        "payload_kg": robot.file.payload_kg,
        "closed_form": robot.closed_form,
        "joints": [
            {
                "name": joint.name,
                "limits_deg": joint.limits_deg,
                "speed_deg_per_s": joint.speed_deg_per_s,
                "acceleration_deg_per_s2": joint.acceleration_deg_per_s2,
            }
            for joint in robot.file.joint
        ],
        "ready_deg": robot.file.ready_deg,
        "sources": robot.file.sources,
        "assumptions": robot.file.assumptions,
    }


def _inverse(robot: Robot) -> str:
    return "closed form" if robot.closed_form else "numeric"
