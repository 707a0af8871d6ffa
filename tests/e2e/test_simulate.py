"""`boxwright simulate`: files, exit status, pictures, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import msgspec
import mujoco
import numpy as np
import pytest
from PIL import Image

from boxwright.io.models import save_model
from boxwright.io.plans import load_plan, save_plan
from boxwright.io.simulations import load_simulation
from boxwright.io.truth import save_truth
from boxwright.robots import load_robot as load_robot_of_core
from boxwright.simulation.physics import Arm, load_robot, true_box
from boxwright.simulation.physics.pictures import CAPTION_HEIGHT_PX
from boxwright.types import FlapOutcome, Plan, Truth
from support.command import boxwright
from support.finger import push_shut
from support.repository import REPOSITORY
from support.scripted_arm import ScriptedArm
from support.true_boxes import carton, truth_of
from support.true_models import model_of

BASE_FROM_INPUT = np.array([[0.0, -1.0, 0.0, 0.6], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, -0.1], [0.0, 0.0, 0.0, 1.0]])


def _turned_numbers(truth: Truth) -> Truth:
    """The same box with every side counted on by one."""

    def named(name: str | None) -> str | None:
        return name if name in (None, "base") else f"{name[:-1]}{(int(name[-1]) + 1) % 4}"

    parts = tuple(msgspec.structs.replace(p, name=named(p.name), parent=named(p.parent)) for p in truth.parts)
    return msgspec.structs.replace(truth, parts=parts)


@pytest.fixture(scope="module")
def plan_dir(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What a planner would write: a scripted arm pushes flap_1 a little past closed."""
    folder = tmp_path_factory.mktemp("plan")
    truth = truth_of(carton())
    arm = Arm(load_robot("viper_s850"))
    segments = ScriptedArm(arm).follow(push_shut(true_box(truth, 0, BASE_FROM_INPUT), "flap_1", -8.0, radius_m=0.011))
    plan = Plan(
        format="boxwright.plan",
        version=1,
        robot="viper_s850",
        base_from_input=tuple(map(tuple, BASE_FROM_INPUT.tolist())),  # type: ignore[arg-type]
        joint_names=tuple(joint.name for joint in arm.robot.joint),
        order=("flap_1",),
        flaps={"flap_1": FlapOutcome(status="planned", reason=None, seconds=0.0)},
        segments=tuple(segments),
        method="script",
    )
    save_plan(plan, folder / "plan.json")
    save_model(model_of(truth), folder / "model.json")
    save_truth(truth, folder / "same.truth.json")
    save_truth(_turned_numbers(truth), folder / "turned.truth.json")
    return folder


def test_a_plan_is_followed_and_told(plan_dir: Path, tmp_path: Path) -> None:
    answer = boxwright("simulate", plan_dir, "-o", tmp_path, "--video", "--truth", plan_dir / "turned.truth.json")
    assert answer.status == 0, answer
    assert "flap_1" in answer.out
    found = load_simulation(tmp_path / "simulation.json")
    assert found.box == "true"
    assert found.flaps["flap_1"].held
    assert found.failure is None
    assert not found.unwanted
    schema = json.loads((REPOSITORY / "docs/schemas/simulation.schema.json").read_text(encoding="utf-8"))
    jsonschema.validate(json.loads((tmp_path / "simulation.json").read_text(encoding="utf-8")), schema)
    with Image.open(tmp_path / "simulation.png") as strip, Image.open(tmp_path / "simulation.gif") as film:
        assert strip.size[0] == 1600
        assert np.asarray(strip.convert("RGB")).std() > 20
        assert film.n_frames > 40  # type: ignore[attr-defined]
        edges = [_edges(film, number) for number in range(0, film.n_frames, 4)]  # type: ignore[attr-defined]
    assert all((edge == edges[0]).all() for edge in edges), "what moves is cut off by the picture's edge"


def _edges(film: Image.Image, number: int) -> np.ndarray:
    """The outermost pixels of a still, the caption left out."""
    film.seek(number)
    still = np.asarray(film.convert("RGB"))[CAPTION_HEIGHT_PX + 1 :]
    return np.concatenate([still[0], still[-1], still[:, 0], still[:, -1]])


def test_without_a_truth_the_inferred_box_is_closed_and_twice_is_the_same(plan_dir: Path, tmp_path: Path) -> None:
    runs = []
    for name in ("a", "b"):
        answer = boxwright("simulate", plan_dir, "-o", tmp_path / name, "--no-picture", "--json")
        assert answer.status == 0, answer
        assert json.loads(answer.out)["box"] == "inferred"
        runs.append(msgspec.structs.replace(load_simulation(tmp_path / name / "simulation.json"), seconds=0.0))
        assert sorted(path.name for path in (tmp_path / name).iterdir()) == ["simulation.json"]
    assert runs[0] == runs[1]


def test_a_run_leaves_nothing_of_an_earlier_one_beside_its_verdict(plan_dir: Path, tmp_path: Path) -> None:
    earlier = ("simulation.gif", "simulation.png", "look_1/model.json", "look_1/plan.json", "notes.txt")
    for name in earlier:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text("earlier", encoding="utf-8")
    assert boxwright("simulate", plan_dir, "-o", tmp_path, "--no-picture").status == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["notes.txt", "simulation.json"]


def test_the_obstacles_of_a_scene_stand_in_physics_too(plan_dir: Path, tmp_path: Path) -> None:
    tip = np.array(load_plan(plan_dir / "plan.json").segments[-1].positions[0])
    x, y, z = load_robot_of_core("viper_s850").forward(tip)[:3, 3] + (0.0, 0.0, 0.12)
    scene = tmp_path / "scene.urdf"
    scene.write_text(
        f'<robot name="s"><link name="lamp"><collision><origin xyz="{x} {y} {z}"/>'
        '<geometry><box size="0.05 0.05 0.02"/></geometry></collision></link></robot>',
        encoding="utf-8",
    )
    answer = boxwright("simulate", plan_dir, "-o", tmp_path, "--no-picture", "--scene", scene)
    assert answer.status in (0, 3), answer
    touched = {second for _, second in load_simulation(tmp_path / "simulation.json").unwanted}
    assert touched == {"scene_lamp"}


def test_a_flap_that_springs_open_is_status_3(plan_dir: Path, tmp_path: Path) -> None:
    answer = boxwright("simulate", plan_dir, "-o", tmp_path, "--no-picture", "--crease", "stiff")
    assert answer.status == 3, answer
    assert not load_simulation(tmp_path / "simulation.json").flaps["flap_1"].held


def test_what_does_not_fit_is_refused_in_one_line(plan_dir: Path, tmp_path: Path) -> None:
    far = msgspec.structs.replace(truth_of(carton(), x_m=3.0), name="far")
    save_truth(far, tmp_path / "far.truth.json")
    cases = (
        (["--crease", "soft"], "must be one of pre_broken, ordinary, stiff"),
        (["--time-step-ms", "2"], "0.001 or less"),
        (["--time-step-ms", "0.0001"], "0.00005 at the least"),
        (["--mass-kg", "inf"], "1000 kg at most"),
        (["--board-mm", "1000"], "board is told to be 1000 mm thick; it is 50 at most"),
        (["--board-mm", "inf"], "board is told to be inf mm thick"),
        (["--truth", str(tmp_path / "far.truth.json")], "no true box is within"),
        (["--scene", str(tmp_path / "gone.urdf")], "gone.urdf: No such file"),
        (["--scene", str(tmp_path / "far.truth.json")], "far.truth.json: is no XML"),
    )
    for options, words in cases:
        answer = boxwright("simulate", plan_dir, "-o", tmp_path / "out", "--no-picture", *options)
        assert answer.status == 1, answer
        (line,) = answer.err.splitlines()
        assert words in line
    assert not (tmp_path / "out").exists()


def test_a_plan_without_a_motion_has_nothing_to_follow(plan_dir: Path, tmp_path: Path) -> None:
    plan = load_plan(plan_dir / "plan.json")
    save_plan(msgspec.structs.replace(plan, order=(), segments=()), tmp_path / "plan.json")
    (tmp_path / "model.json").write_bytes((plan_dir / "model.json").read_bytes())
    answer = boxwright("simulate", tmp_path, "--no-picture")
    assert answer.status == 1, answer
    assert "no segment to follow" in answer.err
    assert not (tmp_path / "simulation.json").exists()


def test_a_robot_is_written_as_mjcf(tmp_path: Path) -> None:
    path = tmp_path / "panda.xml"
    assert boxwright("robots", "franka_panda", "--mjcf", path).status == 0
    model = mujoco.MjModel.from_xml_path(str(path))
    assert model.nu == 9
