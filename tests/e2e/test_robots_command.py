"""`boxwright robots`, as a user runs it."""

from __future__ import annotations

import json
from pathlib import Path

from support.command import boxwright


def test_the_list_and_one_robot() -> None:
    listed = boxwright("robots")
    assert listed.status == 0
    assert all(name in listed.out for name in ("viper_s850", "kuka_kr6_r700", "franka_panda", "closed form", "0.935"))
    told = json.loads(boxwright("robots", "viper_s850", "--json").out)
    assert told[0]["joints"][5]["limits_deg"] == [-360.0, 360.0]
    assert told[0]["assumptions"]


def test_a_robot_written_and_read_again(tmp_path: Path) -> None:
    assert (
        boxwright("robots", "kuka_kr6_r700", "--urdf", tmp_path / "kuka.urdf", "--toml", tmp_path / "k.toml").status
        == 0
    )
    assert "joint_a6" in boxwright("robots", tmp_path / "k.toml").out
    assert (tmp_path / "kuka.urdf").read_text(encoding="utf-8").startswith('<?xml version="1.0"?>')
    # The written URDF has what an arm has not: the fingers' prismatic joints are passed over.
    again = boxwright("robots", tmp_path / "kuka.urdf")
    assert again.status == 0, again.err
    assert "closed form" in again.out


def test_refusals() -> None:
    unknown = boxwright("robots", "r2d2")
    assert unknown.status == 1
    assert unknown.err.strip().count("\n") == 0
    assert "known are franka_panda, kuka_kr6_r700, viper_s850" in unknown.err
    assert boxwright("robots", "--urdf", "x.urdf").status == 2
