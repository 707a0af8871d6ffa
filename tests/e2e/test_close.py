"""`boxwright close`: from a frame to what physics says."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from typer.testing import CliRunner

from boxwright.cli.app import app
from boxwright.cli.plan_options import PlanOptions
from boxwright.io.models import load_model
from boxwright.io.plans import load_plan, load_pose
from boxwright.io.simulations import load_simulation
from boxwright.io.truth import load_truth
from boxwright.types import FlapOutcome, Model, Plan, Pose, Simulation
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
    assert (run.status == 0) == _all_held(simulation)


def _all_held(simulation: Simulation) -> bool:
    return all(flap.held for name, flap in simulation.flaps.items() if name.startswith("flap"))


def test_a_first_plan_that_closes_nothing_is_no_end_where_it_is_looked_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every flap is blocked at first, and none is after a look."""
    made = boxwright("synth", "set", "--count", "1", "--seed", "3", "--category", "medium", folder=tmp_path)
    assert made.status == 0, made.err
    (frame,) = (tmp_path / "set").glob("*.pcd")
    truth, out = str(frame.with_suffix(".truth.json")), tmp_path / "out"
    as_made = PlanOptions.make

    def blocked(self: PlanOptions, model: Model, pose: Pose) -> Plan:
        flap = FlapOutcome(status="blocked", reason="something is in the way", seconds=0.0)
        plan = as_made(self, model, pose)
        return msgspec.structs.replace(plan, segments=(), order=(), flaps=dict.fromkeys(plan.flaps, flap))

    monkeypatch.setattr(PlanOptions, "make", blocked)
    options = ["--robot", "viper_s850", "--place-robot", "--truth", truth, "--crease", "pre_broken", "-o", str(out)]
    folder = out / frame.stem / "plan"
    run = CliRunner().invoke(app, ["close", str(frame), *options])
    assert run.exit_code == 3, run.output
    assert not (folder / "simulation.json").exists()
    run = CliRunner().invoke(app, ["close", str(frame), *options, "--replan"])
    assert run.exit_code in (0, 3), run.output
    simulation = load_simulation(folder / "simulation.json")
    assert sum(flap.held for flap in simulation.flaps.values()) >= 2
    assert (run.exit_code == 0) == _all_held(simulation)
    assert len(list(folder.glob("look_*"))) >= 2


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--robot", "nosuch"], "viper_s850"),
        (["--scene", "gone.urdf"], "gone.urdf: No such file"),
        (["--crease", "soft"], "pre_broken, ordinary, stiff"),
        (["--template", "nosuch"], "nosuch"),
        (["--truth", "gone.truth.json"], "gone.truth.json: No such file"),
        (["--camera-pose", "gone.json"], "gone.json: No such file"),
        (["--catalogue", "gone.toml"], "gone.toml: No such file"),
    ],
)
def test_what_cannot_be_used_is_refused_before_any_work(
    options: list[str], said: str, frame: Path, tmp_path: Path
) -> None:
    given = {"--robot": "viper_s850", "--camera-pose": str(_far(tmp_path)), options[0]: options[1]}
    words = [word for pair in given.items() for word in pair]
    run = boxwright("close", frame, *words, "-o", "out", folder=tmp_path)
    assert run.status == 1, run
    (line,) = run.err.splitlines()
    assert said in line
    assert not (tmp_path / "out").exists()


def test_what_is_known_of_the_box_counts_and_is_told_as_infer_tells_it(
    scene_set: Path, frame: Path, tmp_path: Path
) -> None:
    """Nothing can be planned here: an earlier plan is gone all the same."""
    dims = load_truth(scene_set / "small_0000.truth.json").boxes[0].dims
    assert dims is not None
    size = "x".join(f"{1000.0 * metres:.0f}" for metres in dims)
    plan = tmp_path / "out" / "small_0000" / "plan"
    plan.mkdir(parents=True)
    (plan / "trajectory.csv").write_text("earlier", encoding="utf-8")
    run = boxwright(
        "close", frame, "--robot", "viper_s850", "--camera-pose", _far(tmp_path), "--size", size, "--verbose",
        "-o", "out", folder=tmp_path,
    )  # fmt: skip
    assert run.status == 1, run
    assert "out of reach" in run.err
    (found, *_) = load_model(plan.parent / "model.json").objects
    assert found.size is not None
    assert f"has the size {size} mm" in run.out
    assert not (plan / "trajectory.csv").exists()


def test_several_frames_of_a_box_are_closed_as_one(tmp_path: Path) -> None:
    made = boxwright("synth", "set", "--count", "1", "--seed", "5", "--category", "small", "--views", "2",
                     folder=tmp_path)  # fmt: skip
    assert made.status == 0, made.err
    (poses,) = (tmp_path / "set").glob("*.poses.toml")
    frame = poses.with_name(poses.name.replace(".poses.toml", ".pcd"))
    options = ("--robot", "viper_s850", "--camera-pose", _far(tmp_path), "-o", "out")
    run = boxwright("close", "--poses", poses, *options, folder=tmp_path)
    assert run.status == 1, run
    assert "out of reach" in run.err
    (folder,) = (tmp_path / "out").iterdir()
    assert len(load_model(folder / "model.json").source.frames) == 2
    assert boxwright("close", frame, "--poses", poses, *options, folder=tmp_path).status == 2
    assert boxwright("close", *options, folder=tmp_path).status == 2


def _far(folder: Path) -> Path:
    path = folder / "far.json"
    path.write_text('{"position": [5.0, 0.0, 0.0], "orientation": [1.0, 0.0, 0.0, 0.0]}', encoding="utf-8")
    return path


def test_close_wants_a_pose_or_a_place(tmp_path: Path) -> None:
    run = boxwright("close", "frame.pcd", "--robot", "viper_s850", "-o", "out", folder=tmp_path)
    assert run.status == 2
    assert "--place-robot" in run.err
