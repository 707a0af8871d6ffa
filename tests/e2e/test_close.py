"""`boxwright close`: from a frame to what physics says."""

from __future__ import annotations

from pathlib import Path

from boxwright.io.models import load_model
from boxwright.io.plans import load_plan, load_pose
from boxwright.io.simulations import load_simulation
from support.command import boxwright


def test_close_goes_the_whole_way(tmp_path: Path) -> None:
    made = boxwright("synth", "set", "--count", "1", "--seed", "3", "--category", "medium", folder=tmp_path)
    assert made.status == 0, made.err
    (frame,) = (tmp_path / "set").glob("*.pcd")
    truth = frame.with_suffix(".truth.json")
    run = boxwright(
        "close", frame, "--robot", "viper_s850", "--place-robot", "--truth", truth, "--method", "fitted", "-o", "out",
        folder=tmp_path,
    )  # fmt: skip
    assert run.status in (0, 3), run.err
    folder = tmp_path / "out" / frame.stem / "plan"
    plan, simulation = load_plan(folder / "plan.json"), load_simulation(folder / "simulation.json")
    assert load_pose(folder / "camera_pose.json").position != (0.0, 0.0, 0.0)
    assert plan.order, "a place was found from which something can be closed"
    assert simulation.box == "true"
    held = all(simulation.flaps[name].held for name in plan.order if name in simulation.flaps)
    assert held or run.status == 3
    assert (folder / "simulation.png").stat().st_size > 10_000


def test_close_looks_again_after_each_flap(tmp_path: Path) -> None:
    made = boxwright("synth", "set", "--count", "1", "--seed", "3", "--category", "medium", folder=tmp_path)
    assert made.status == 0, made.err
    (frame,) = (tmp_path / "set").glob("*.pcd")
    run = boxwright(
        "close", frame, "--robot", "viper_s850", "--place-robot", "--truth", frame.with_suffix(".truth.json"),
        "--replan", "--crease", "pre_broken", "-o", "out", folder=tmp_path,
    )  # fmt: skip
    assert run.status in (0, 3), run.err
    folder = tmp_path / "out" / frame.stem / "plan"
    simulation = load_simulation(folder / "simulation.json")
    looks = sorted(folder.glob("look_*"))
    assert len(looks) >= 2
    for look in looks:
        plan, model = load_plan(look / "plan.json"), load_model(look / "model.json")
        assert len(plan.order) == 1
        assert plan.order[0] in {joint.child for joint in model.objects[plan.object].joints}
    assert simulation.crease == "pre_broken"
    pushed = [flap for flap in simulation.flaps.values() if flap.pushed_to_rad is not None]
    assert sum(flap.held for flap in pushed) >= 2


def test_close_wants_a_pose_or_a_place(tmp_path: Path) -> None:
    run = boxwright("close", "frame.pcd", "--robot", "viper_s850", "-o", "out", folder=tmp_path)
    assert run.status == 2
    assert "--place-robot" in run.err
