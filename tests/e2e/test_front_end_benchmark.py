"""benchmarks/front_end.py: our own row, and what is said of a peer that is not there."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

from support.repository import REPOSITORY

SCRIPT = REPOSITORY / "benchmarks" / "front_end.py"


@pytest.fixture(scope="module")
def printed() -> str:
    """On two frames, where no cmake is found."""
    command = [sys.executable, SCRIPT, "--frames", "2", "--repeats", "1", "--seed", "5", "--vga-only", "--list-missed"]
    ran = subprocess.run(
        [*command, "--only", "ransac", "organized"],
        env=os.environ | {"PATH": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_rows_are_measured_or_say_why_not(printed: str) -> None:
    rows = {line.split("|")[1].strip(): line for line in printed.splitlines() if line.startswith("| ")}
    ours = [cell.strip() for cell in rows["boxwright, planes=ransac"].split("|")]
    assert ours[2] == "2"
    assert 0 < float(ours[3]) <= float(ours[4])
    assert all(50 < float(cell) <= 100 for cell in ours[5:8])
    assert "not measured: PCL is not installed" in rows["PCL: organized multi-plane segmentation"]


def test_recall_by_role_sums_up_and_misses_are_listed(printed: str) -> None:
    rows = [line.split("|") for line in printed.splitlines() if line.startswith("| ") and " of " in line]
    cells = {row[1].strip(): row[2].split() for row in rows}
    for suffix in ("", ", pairs as two"):
        roles = [cells[role + suffix] for role in ("base", "side", "flap", "tuck", "pair") if role + suffix in cells]
        assert [sum(int(row[k]) for row in roles) for k in (0, 2)] == [int(cells["all" + suffix][k]) for k in (0, 2)]
    assert printed.count("missed: ") == int(cells["all"][2]) - int(cells["all"][0])
