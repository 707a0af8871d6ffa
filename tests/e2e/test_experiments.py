"""benchmarks/experiments: each runs, tiny, and writes its table, its figures and its picture; the same ones again."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

from support.repository import REPOSITORY

ALL = ("table_one", "keep_fraction", "search_cost", "left_out", "chain", "training_size", "conditions", "plane_stage")
LARGEST_PICTURE = 60_000


def _run(folder: Path, *names: str) -> str:
    command = [sys.executable, "-m", "benchmarks.experiments", *names, "--quick", "--out", str(folder)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=REPOSITORY)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_each_writes_its_files(tmp_path: Path) -> None:
    said = _run(tmp_path)
    for name in ALL:
        assert re.search(rf"^{name}: \d+ s", said, re.MULTILINE)
        content = json.loads((tmp_path / f"{name}.json").read_text())
        page = (tmp_path / f"{name}.md").read_text()
        assert content["experiment"] == name
        assert content["command"] in page
        assert f"({name}.png)" in page
        for table in content["tables"]:
            assert table["rows"]
            assert {len(row) for row in table["rows"]} == {len(table["columns"])}
            assert len(set(table["columns"])) == len(table["columns"])
        picture = (tmp_path / f"{name}.png").read_bytes()
        assert picture.startswith(b"\x89PNG")
        assert len(picture) < LARGEST_PICTURE


def test_the_same_figures_again(tmp_path: Path) -> None:
    for name in ("first", "second"):
        _run(tmp_path / name, "training_size")
    first, second = ((tmp_path / name / "training_size.json").read_bytes() for name in ("first", "second"))
    assert first == second


def test_an_experiment_that_is_not_there_is_told(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "benchmarks.experiments", "table_two", "--out", str(tmp_path)]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=REPOSITORY)
    assert ran.returncode == 2
    assert "table_two: no such experiment; there are table_one" in ran.stderr
    assert not list(tmp_path.iterdir())
