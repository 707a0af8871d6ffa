"""`boxwright demo` and `synth`, and help that helps."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from boxwright import models
from boxwright.cli import demo
from boxwright.evaluation.verdicts import PANEL_READINGS
from boxwright.simulation import make_frame
from support.command import boxwright

COMMANDS = ("demo", "infer", "explain", "figure", "evaluate", "synth", "train")


@pytest.mark.skipif(
    not (Path(models.__file__).parent / "weights/grid/carton.json").is_file(),
    reason="no learned weights are shipped yet",
)
def test_the_demo_writes_everything_and_says_where(tmp_path: Path) -> None:
    answer = boxwright("demo", "-o", "here", folder=tmp_path)
    assert answer.status == 0, answer.err
    folder = tmp_path / "here"
    assert {path.name for path in folder.iterdir()} == {"frame", "frame.pcd", "frame.truth.json", "frame.labels.npz"}
    names = {path.name for path in (folder / "frame").iterdir()}
    assert names >= {"model.json", "labels.npz", "frame.png"}
    assert all(name in answer.out for name in names)
    assert "true angle" in answer.out
    assert sum(line.strip().startswith("flap_") for line in answer.out.splitlines()) == 4


def test_the_demo_shows_what_its_seed_is_chosen_for() -> None:
    truth = make_frame(demo.CATEGORY, demo.SEED, boxes=1).truth
    visible = [part.name.rstrip("0123456789") for part in truth.parts if part.visible_px >= PANEL_READINGS]
    assert (visible.count("flap"), visible.count("base")) == (4, 1)
    assert visible.count("side") >= 3


def test_synth_makes_the_same_set_for_a_seed(tmp_path: Path) -> None:
    for name in ("a", "b"):
        answer = boxwright("synth", name, "--count", "2", "--seed", "4", "--json", folder=tmp_path)
        assert (answer.status, answer.err) == (0, "")
        assert len(json.loads(answer.out)["frames"]) == 2
    files = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert len(files) == 6
    assert all((tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes() for name in files)


def test_help_names_every_command() -> None:
    answer = boxwright("--help")
    assert answer.status == 0
    assert all(command in answer.out for command in COMMANDS)


@pytest.mark.parametrize("command", [command for command in COMMANDS if command != "demo"])
def test_help_shows_how(command: str) -> None:
    answer = boxwright(command, "--help")
    assert answer.status == 0
    assert f"boxwright {command} " in answer.out.split("Example", 1)[1]
