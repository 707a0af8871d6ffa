"""plan.json and trajectory.csv: what they take, what they refuse, and that they read back the same."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import msgspec
import pytest

from boxwright.io.plans import load_plan, load_trajectory, samples, save_plan, save_trajectory
from boxwright.io.schemas import schema_text
from boxwright.types import Plan
from support.sample_plan import sample_plan


def _write(data: dict[str, Any], folder: Path) -> Path:
    path = folder / "plan.json"
    path.write_text(json.dumps(data), encoding="utf-8")
    return path


def test_a_plan_reads_back_the_same_and_fits_its_schema(tmp_path: Path) -> None:
    plan = load_plan(_write(sample_plan() | {"later": 1}, tmp_path))
    save_plan(plan, tmp_path / "again.json")
    assert load_plan(tmp_path / "again.json") == plan
    written = json.loads((tmp_path / "again.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator(json.loads(schema_text("plan.schema.json"))).validate(written)


def test_a_trajectory_has_each_sample_once_and_reads_back_bit_for_bit(tmp_path: Path) -> None:
    plan = msgspec.convert(sample_plan(), Plan)
    save_trajectory(plan, tmp_path / "trajectory.csv")
    names, rows = load_trajectory(tmp_path / "trajectory.csv")
    assert names == plan.joint_names
    assert rows == list(samples(plan))
    assert len(rows) == 4 * 3 - 3, "the sample that two segments share stands once"
    header = (tmp_path / "trajectory.csv").read_text(encoding="utf-8").splitlines()[0]
    assert header == "time_s,joint_1_rad,joint_2_rad"


Change = Callable[[dict[str, Any]], None]

BAD: list[tuple[str, Change, str]] = [
    ("format", lambda d: d.update(format="other"), "format"),
    ("rotation", lambda d: d["base_from_input"][0].__setitem__(0, 1.1), "holds no rotation"),
    ("mirror", lambda d: d["base_from_input"][2].__setitem__(2, -1.0), "right-handed"),
    ("last row", lambda d: d["base_from_input"][3].__setitem__(0, 1.0), "it must be 0, 0, 0, 1"),
    ("status", lambda d: d["flaps"]["flap_0"].update(status="lost"), "flaps"),
    ("reason", lambda d: d["flaps"]["flap_0"].update(reason=None), "planned flaps alone have none"),
    ("order", lambda d: d.update(order=["flap_0"]), "which is no planned flap"),
    ("row", lambda d: d["segments"][1]["positions"].__setitem__(1, [0.0]), "joint_names has 2"),
    ("rows", lambda d: d["segments"][1]["velocities"].pop(), "must be as many"),
    ("times", lambda d: d["segments"][1]["times"].__setitem__(1, 0.0), "times do not grow"),
    ("gap", lambda d: d["segments"].pop(1), "the one before ends at another"),
    ("jump", lambda d: d["segments"][1]["positions"].__setitem__(0, [0.0, 0.0]), "other positions"),
    ("flap", lambda d: d["segments"][0].update(flap="flap_1"), "null in transit alone"),
    ("no contact", lambda d: d["segments"][2].update(contact=None), "belongs to a push"),
    ("contact", lambda d: d["segments"][1].update(contact=[[0, 0, 0]] * 3), "belongs to a push"),
]


@pytest.mark.parametrize(("change", "said"), [case[1:] for case in BAD], ids=[case[0] for case in BAD])
def test_what_is_no_plan_is_refused_in_one_line(change: Change, said: str, tmp_path: Path) -> None:
    data = sample_plan()
    change(data)
    path = _write(data, tmp_path)
    with pytest.raises(ValueError, match=r"plan\.json") as refusal:
        load_plan(path)
    assert said in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "line 1: is no header"),
        ("a,b\n", "line 1: is no header"),
        ("time_s,j_rad\n0.0\n", "line 2: holds 1 values; the header has 2"),
        ("time_s,j_rad\n0.0,x\n", "it must hold numbers"),
    ],
)
def test_what_is_no_trajectory_is_refused(text: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "trajectory.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=r"trajectory\.csv") as refusal:
        load_trajectory(path)
    assert said in str(refusal.value)
