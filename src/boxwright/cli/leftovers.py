"""What an earlier plan or run left in a folder: beside a newer one it would be taken for what belongs to that."""

from __future__ import annotations

from pathlib import Path

PLAN_FILES = ("plan.json", "trajectory.csv", "trajectory.mcap")
RUN_FILES = ("simulation.json", "simulation.png", "simulation.gif")
LOOK = "look_"
LOOK_FILES = ("model.json", "plan.json")


def remove_plan(folder: Path, keep: Path | None = None) -> None:
    """Removes an earlier plan with its trajectories, and what was run of it; nothing that boxwright does not write.

    The model and the pose stay: a user may name them again. So does the look `keep`, which is being worked on.
    """
    for name in PLAN_FILES:
        (folder / name).unlink(missing_ok=True)
    remove_run(folder, keep)


def remove_run(folder: Path, keep: Path | None = None) -> None:
    """Removes an earlier run's verdict, pictures and looks; of looks boxwright's own files, and what is empty then."""
    for name in RUN_FILES:
        (folder / name).unlink(missing_ok=True)
    for look in folder.glob(f"{LOOK}*"):
        is_look = look.name.removeprefix(LOOK).isdecimal() and look.is_dir()
        if is_look and not (keep is not None and look.resolve() == keep.resolve()):
            for name in LOOK_FILES:
                (look / name).unlink(missing_ok=True)
            if not look.is_symlink() and not any(look.iterdir()):
                look.rmdir()
