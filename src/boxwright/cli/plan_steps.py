"""The steps that `boxwright plan` and `boxwright close` share."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from boxwright.types import Model, Plan, Pose


def require_place(camera_pose: Path | None, place_robot: bool) -> None:
    """Where the robot stands is told, or searched: one of both, else the command line is wrong."""
    if (camera_pose is None) != place_robot:
        raise typer.BadParameter("give one of --camera-pose POSE.json and --place-robot", param_hint="--camera-pose")


def base_pose(model: Model, robot: str, camera_pose: Path | None, place_robot: bool, object_index: int) -> Pose:
    """base_from_input: as it was told, or as the search for a place finds it. A wrong command line without either."""
    require_place(camera_pose, place_robot)
    if camera_pose is not None:
        from boxwright.io.plans import load_pose

        return load_pose(camera_pose)
    from boxwright.planning import place_robot as search

    return search(model, robot, object_index=object_index)


def make_plan(model: Model, robot: str, pose: Pose, object_index: int, scene: Path | None, planner: str) -> Plan:
    """The plan; raises as `plan_closing` does."""
    from boxwright.planning import plan_closing, read_scene

    things = () if scene is None else read_scene(scene)
    return plan_closing(model, robot, pose, object_index=object_index, scene=things, method=planner)


def save_plan_folder(plan: Plan, model: Model, pose: Pose, folder: Path) -> list[Path]:
    """Writes plan, model, pose and trajectories; the files that were written."""
    from boxwright.io.models import save_model
    from boxwright.io.plans import save_plan, save_pose, save_trajectory
    from boxwright.io.ros_trajectories import save_ros_trajectory

    folder.mkdir(parents=True, exist_ok=True)
    files = [folder / "plan.json", folder / "model.json", folder / "camera_pose.json"]
    save_plan(plan, files[0])
    save_model(model, files[1])
    save_pose(pose, files[2])
    if plan.segments:
        files += [folder / "trajectory.csv", folder / "trajectory.mcap"]
        save_trajectory(plan, files[3])
        save_ros_trajectory(plan, files[4])
    return files
