"""benchmarks/error_causes.py: every lost point has one cause."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from boxwright.evaluation import list_set
from boxwright.pipeline import DEFAULT_METHOD
from boxwright.scoring import score_entries
from support.repository import REPOSITORY

SCRIPT = REPOSITORY / "benchmarks" / "error_causes.py"
FRAMES = ("small_0000", "medium_0001")


@pytest.fixture
def two_frames(scene_set: Path, tmp_path: Path) -> Path:
    """One frame as it is, and one whose cloud is refused: there is always something lost."""
    folder = tmp_path / "two"
    folder.mkdir()
    for path in scene_set.iterdir():
        if path.name.startswith(FRAMES):
            shutil.copy(path, folder)
    (folder / "small_0000.pcd").write_bytes(b"no cloud")
    return folder


def test_causes_sum_to_what_is_lost(two_frames: Path, tmp_path: Path) -> None:
    out = tmp_path / "causes.json"
    ran = subprocess.run(
        [sys.executable, SCRIPT, two_frames, "--json", out], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
    figures = json.loads(out.read_text())
    entries = list_set(two_frames)
    outcomes = score_entries(entries, method=DEFAULT_METHOD, templates=None, weights=None, jobs=1)
    boxes = [box for outcome in outcomes if outcome.score for box in outcome.score.boxes]
    lost = sum(box.panels_in_cloud - box.panels_right + box.panels_wrong for box in boxes)
    causes = figures["causes"]
    assert sum(row["count"] for row in causes.values()) == figures["lost"] == lost
    assert all(sum(row["kinds"].values()) == row["count"] for row in causes.values())
    assert sum(row["share_percent"] for row in causes.values()) == pytest.approx(100.0)
    full = 100.0 * sum(box.full_accuracy or 0.0 for box in boxes) / len(boxes)
    assert sum(row["full_accuracy_percent"] for row in causes.values()) == pytest.approx(100.0 - full)
    (refused,) = (box for box in boxes if box.category == "small")
    assert causes["box missed altogether"]["count"] >= refused.panels_in_cloud > 0
    assert figures["frames_refused"] == 1
    found = figures["found_by_perception"]["all"]
    assert found["there"] == sum(box.panels_in_cloud for box in boxes)
    assert "The largest causes" in ran.stdout
