"""The files that `boxwright plan` and `boxwright close` write."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from boxwright.types import Model, Plan, Pose


def save_plan_folder(plan: Plan, model: Model, pose: Pose, folder: Path, keep: Path | None = None) -> list[Path]:
    """Writes plan, model, pose and trajectories; the files that were written.

    What an earlier plan and its runs left there goes first: an arm must not follow it for a plan that closes nothing.
    A look `keep`, which the model was read from, stays.
    """
    from boxwright.cli.leftovers import remove_plan
    from boxwright.io.models import save_model
    from boxwright.io.plans import save_plan, save_pose, save_trajectory
    from boxwright.io.ros_trajectories import save_ros_trajectory

    folder.mkdir(parents=True, exist_ok=True)
    remove_plan(folder, keep)
    files = [folder / "plan.json", folder / "model.json", folder / "camera_pose.json"]
    save_plan(plan, files[0])
    save_model(model, files[1])
    save_pose(pose, files[2])
    if plan.segments:
        files += [folder / "trajectory.csv", folder / "trajectory.mcap"]
        save_trajectory(plan, files[3])
        save_ros_trajectory(plan, files[4])
    return files
