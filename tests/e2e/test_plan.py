"""`boxwright plan`: its files, exit codes and messages."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import msgspec
import pytest
from closing.problems import draw_problem

from boxwright.io.models import save_model
from boxwright.io.plans import load_plan, load_trajectory
from boxwright.io.schemas import schema_text
from boxwright.types import Model
from support.command import Answer, boxwright

HERE = {"position": [0.0, 0.0, 0.0], "orientation": [0.0, 0.0, 0.0, 1.0]}


@pytest.fixture
def model_dir(tmp_path: Path) -> Path:
    """A pizza box with one flap, a tuck on it, in the base frame."""
    folder = tmp_path / "box"
    folder.mkdir()
    save_model(draw_problem(11).model, folder / "model.json")
    return folder


def _pose(folder: Path, **change: Any) -> Path:
    path = folder / "pose.json"
    path.write_text(json.dumps(HERE | change), encoding="utf-8")
    return path


def _plan(model_dir: Path, *options: str) -> Answer:
    return boxwright("plan", str(model_dir), "-o", str(model_dir / "plan"), *options)


def test_plan_writes_its_files(model_dir: Path) -> None:
    run = _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(_pose(model_dir)))
    assert run.status == 0, run.err
    folder = model_dir / "plan"
    assert {path.name for path in folder.iterdir()} == {
        "plan.json", "model.json", "camera_pose.json", "trajectory.csv", "trajectory.mcap"
    }  # fmt: skip
    plan = load_plan(folder / "plan.json")
    jsonschema.validate(json.loads((folder / "plan.json").read_text()), json.loads(schema_text("plan.schema.json")))
    assert plan.order == ("flap_1",)
    names, rows = load_trajectory(folder / "trajectory.csv")
    assert names == plan.joint_names
    assert rows[-1][0] == plan.segments[-1].times[-1]


def test_json_prints_the_plan(model_dir: Path) -> None:
    run = _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(_pose(model_dir)), "--json")
    assert json.loads(run.out)["format"] == "boxwright.plan"


def test_a_flap_that_stays_open_gives_three_and_says_why(model_dir: Path) -> None:
    pose = _pose(model_dir, position=[0.62, -0.4, 0.0])
    run = _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(pose))
    assert run.status == 3, run.err
    plan = load_plan(model_dir / "plan" / "plan.json")
    (flap,) = plan.flaps.values()
    assert flap.status in ("unreachable", "joint_limit", "blocked")
    assert flap.reason


def test_a_plan_that_closes_nothing_leaves_no_earlier_motion_and_nothing_foreign_is_removed(model_dir: Path) -> None:
    folder = model_dir / "plan"
    assert _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(_pose(model_dir))).status == 0
    run_of_it = ("simulation.json", "simulation.png", "simulation.gif", "look_1/plan.json", "look_2/model.json")
    foreign = ("simulation.txt", "look_2/notes.txt", "look_at_this/plan.json", "trajectory.csv.bak")
    for name in (*run_of_it, *foreign):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text("earlier", encoding="utf-8")
    far = _pose(model_dir, position=[0.62, -0.4, 0.0])
    run = _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(far))
    assert run.status == 3, run.err
    left = {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}
    assert left == {"plan.json", "model.json", "camera_pose.json", *foreign}
    assert not (folder / "look_1").exists()


def test_a_look_can_be_planned_on_into_the_folder_that_it_lies_in(model_dir: Path) -> None:
    """The first look of an earlier run, once more."""
    look = model_dir / "plan" / "look_1"
    look.mkdir(parents=True)
    (look / "model.json").write_bytes((model_dir / "model.json").read_bytes())
    pose = str(_pose(model_dir))
    run = boxwright("plan", look, "-o", model_dir / "plan", "--robot", "viper_s850", "--camera-pose", pose)
    assert run.status == 0, run.err
    assert (look / "model.json").exists()


REFUSED = [
    ("unknown robot", ("--robot", "robby"), {}, 1, "viper_s850"),
    ("out of reach", ("--robot", "viper_s850"), {"position": [5.0, 0.0, 0.0]}, 1, "out of reach"),
    ("below the floor", ("--robot", "viper_s850"), {"orientation": [1.0, 0.0, 0.0, 0.0]}, 1, "below the floor"),
    ("base inside the box", ("--robot", "viper_s850"), {"position": [-0.48, 0.33, 0.08]}, 1, "stands inside"),
    ("no unit quaternion", ("--robot", "viper_s850"), {"orientation": [0, 0, 0, 2]}, 1, "pose.json: "),
    ("unknown crease", ("--robot", "viper_s850", "--crease", "soft"), {}, 1, "pre_broken, ordinary, stiff"),
    ("no such object", ("--robot", "viper_s850", "--object", "3"), {}, 1, "object 3 is not in the model"),
]


@pytest.mark.parametrize(("options", "pose", "status", "said"), [c[1:] for c in REFUSED], ids=[c[0] for c in REFUSED])
def test_what_cannot_be_used_is_one_line(
    options: tuple[str, ...], pose: dict[str, Any], status: int, said: str, model_dir: Path
) -> None:
    run = _plan(model_dir, *options, "--camera-pose", str(_pose(model_dir, **pose)))
    assert run.status == status, run.err
    assert said in run.err
    assert len(run.err.strip().splitlines()) == 1, run.err


def test_the_class_of_creases_decides_how_far_a_flap_is_pushed(tmp_path: Path) -> None:
    folder = tmp_path / "box"
    folder.mkdir()
    save_model(draw_problem(3).model, folder / "model.json")
    last_rad = {}
    for crease in ("pre_broken", "ordinary"):
        run = _plan(folder, "--robot", "viper_s850", "--camera-pose", str(_pose(folder)), "--crease", crease)
        assert run.status in (0, 3), run.err
        plan = load_plan(folder / "plan" / "plan.json")
        pushes = [segment.hinge_angle_rad for segment in plan.segments if segment.hinge_angle_rad is not None]
        last_rad[crease] = min(angles[-1] for angles in pushes)
    assert last_rad["ordinary"] < last_rad["pre_broken"] < 0.0


def test_a_model_without_flaps_is_refused(model_dir: Path) -> None:
    model: Model = draw_problem(11).model
    bare = msgspec.structs.replace(model, objects=(msgspec.structs.replace(model.objects[0], joints=()),))
    save_model(bare, model_dir / "model.json")
    run = _plan(model_dir, "--robot", "viper_s850", "--camera-pose", str(_pose(model_dir)))
    assert run.status == 1
    assert "has no flaps" in run.err
    assert len(run.err.strip().splitlines()) == 1


def test_a_pose_or_a_place_must_be_given(model_dir: Path) -> None:
    run = _plan(model_dir, "--robot", "viper_s850")
    assert run.status == 2
    assert "--camera-pose" in run.err
