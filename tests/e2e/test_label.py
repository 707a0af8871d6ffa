"""`boxwright label`: from clouds to a set that train and evaluate read."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from boxwright.evaluation import list_set, read_set
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.models import load_template, load_weights
from boxwright.simulation import write_set
from support.command import COMMAND, Answer, boxwright
from support.hand_labels import fill_forms

PARTS = load_template("carton").parts
FRAMES = 10


@pytest.fixture(scope="module")
def clouds(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten simulated frames with their truth, and one without a box."""
    folder = tmp_path_factory.mktemp("clouds")
    write_set(folder, FRAMES, 21, ("small", "medium", "large", "carton"), boxes=1)
    write_set(folder, 1, 22, ("none",))
    return folder


def _label(clouds: list[Path], folder: Path, *more: str, typed: str | None = None) -> Answer:
    if typed is None:
        return boxwright("label", *clouds, "-o", folder, "--template", "carton", "--no-figure", *more)
    done = subprocess.run(
        [COMMAND, "label", *clouds, "-o", folder, "--template", "carton", "--no-figure", *more],
        input=typed, capture_output=True, text=True, timeout=120, check=False,
    )  # fmt: skip
    assert "Traceback" not in done.stderr
    return Answer(done.returncode, done.stdout, done.stderr)


def test_ten_frames_labelled_by_hand_teach_a_carton(clouds: Path, tmp_path: Path) -> None:
    boxes = sorted(path for path in clouds.glob("*.pcd") if not path.name.startswith("none"))
    mine = tmp_path / "mine"
    assert len(boxes) == FRAMES
    first = _label(boxes, mine)
    assert (first.status, first.err, first.out.count("wait for roles")) == (0, "", FRAMES)
    assert not list(mine.glob("*.pcd"))
    typed = fill_forms(clouds, mine, PARTS)
    assert typed > 4 * FRAMES

    second = _label(boxes, mine, "--category", "ours", "--json")
    assert second.status == 0, second.err
    assert all("from the other pieces of" in line for line in second.err.splitlines())
    told = json.loads(second.out)
    assert [row["status"] for row in told] == ["labelled"] * FRAMES
    assert _label(list(clouds.glob("none*.pcd")), mine, "--no-box").status == 0
    assert len(list_set(mine)) == FRAMES + 1

    right = 0
    for frame in read_set(mine):
        exact = read_truth_labels(clouds / f"{frame.name}.labels.npz")
        truth = load_truth(clouds / f"{frame.name}.truth.json")
        names = ["", *(part.name for part in truth.parts)]
        for label, part in enumerate(frame.truth.parts, 1):
            there = exact[frame.labels == label]
            right += sum(names[k] == part.name for k in there) * 2 >= len(there)
    assert right == sum(row["panels"] for row in told)

    weights = tmp_path / "mine.json"
    learned = boxwright("train", mine, "--template", "carton", "--planes", "grid", "-o", weights)
    assert learned.status == 0, learned.err
    report = load_weights(weights).training
    assert report is not None
    assert report.frames == FRAMES + 1
    used = ("--method", "paper", "--template", "carton", "--weights", weights, "--planes", "grid", "--json")
    scored = boxwright("evaluate", mine, *used)
    assert (scored.status, scored.err) == (0, "")
    of_all = json.loads(scored.out)["categories"][-1]
    assert of_all["boxes"] >= FRAMES - 1
    assert of_all["full_accuracy_percent"] > 50.0
    assert of_all["usable_flaps_percent"] is None, "nobody measured the hinges"
    assert boxwright("evaluate", clouds, *used).status == 0


def test_roles_are_asked_for(clouds: Path, tmp_path: Path) -> None:
    cloud = next(clouds.glob("small*.pcd"))
    form = tmp_path / "forms" / cloud.stem / f"{cloud.stem}.roles.toml"
    short = _label([cloud], tmp_path, "--ask", typed="side_7\nside_0\n")
    assert short.status == 1
    assert "carton has no part 'side_7'; known are base, side_0" in short.out
    assert "answers ended at segment 1" in short.err
    assert '0  = "side_0"' in form.read_text()
    segments = form.read_text().partition("[roles]\n")[2].count("\n")
    done = _label([cloud], tmp_path, "--ask", typed="\nflap_0\n" + "\n" * (segments - 2))
    assert (done.status, done.err) == (0, "")
    truth = load_truth(tmp_path / f"{cloud.stem}.truth.json")
    assert [part.name for part in truth.parts] == ["side0", "flap0"]


def test_what_cannot_be_labelled_is_refused(clouds: Path, tmp_path: Path) -> None:
    cloud = next(clouds.glob("medium*.pcd"))
    assert _label([cloud], clouds).status == 2, "a set holds labelled frames alone"
    assert _label([cloud], tmp_path, "--frame", "opengl").status == 2
    assert _label([cloud], tmp_path, "--ask", "--no-box").status == 2
    assert _label([cloud], tmp_path).status == 0
    again = _label([cloud], tmp_path)
    assert (again.status, again.out.count("wait for roles")) == (0, 1)

    form = tmp_path / "forms" / cloud.stem / f"{cloud.stem}.roles.toml"
    empty = form.read_text()
    for typed, reason in (("tuck_0", "is a part of cake_box"), ("a b.base", "no box's name")):
        form.write_text(empty.replace('1  = ""', f'1  = "{typed}"'))
        refused = _label([cloud], tmp_path)
        (line,) = refused.err.splitlines()
        assert refused.status == 1
        assert f"{form}: line " in line
        assert reason in line
    form.write_text(empty.replace('1  = ""', '1  = "base"'))
    assert "leave out --no-box" in _label([cloud], tmp_path, "--no-box").err
    other = boxwright("label", cloud, "-o", tmp_path, "--template", "cake_box", "--no-figure")
    assert "template: is 'carton'" in other.err
    form.write_text(empty.replace("points = 307200", "points = 3"))
    assert "remove the form to begin anew" in _label([cloud], tmp_path).err
