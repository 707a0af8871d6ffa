"""Every example is short, numbered without a gap, and runs."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from support.repository import PACKAGE, REPOSITORY

EXAMPLES = sorted((REPOSITORY / "examples").glob("*.py"))

WEIGHTS = PACKAGE / "models" / "weights"


def test_examples_are_numbered_and_short() -> None:
    assert len(EXAMPLES) >= 4
    assert [path.name[:3] for path in EXAMPLES] == [f"{number:02d}_" for number in range(1, len(EXAMPLES) + 1)]
    for path in EXAMPLES:
        assert len(path.read_text(encoding="utf-8").splitlines()) < 40, path.name


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_runs(path: Path, tmp_path: Path) -> None:
    understands = any(call in path.read_text(encoding="utf-8") for call in ("boxwright.infer(", "boxwright.evaluate("))
    if understands and not WEIGHTS.is_dir():
        pytest.skip("no weights are shipped yet; `boxwright train` makes them")
    run = subprocess.run([sys.executable, path], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    assert run.stdout.strip(), "an example shows something"
    assert not run.stderr.strip(), run.stderr
