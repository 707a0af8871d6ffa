"""`boxwright --help` waits for nothing heavy; benchmarks/bench.py tells its time."""

from __future__ import annotations

import subprocess
import sys

HEAVY = ("numpy", "scipy", "matplotlib", "msgspec", "mujoco", "boxwright._core", "boxwright.pipeline")

ASK = """
import sys
sys.argv = ["boxwright", *{arguments!r}]
from boxwright.cli import main
try:
    main()
except SystemExit as stop:
    assert not stop.code, stop.code
print("imported:", *(name for name in {heavy!r} if name in sys.modules))
"""


def test_help_imports_nothing_heavy() -> None:
    for arguments in (["--help"], ["infer", "--help"], ["--version"]):
        script = ASK.format(arguments=arguments, heavy=HEAVY)
        answer = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
        assert "boxwright" in answer
        assert answer.splitlines()[-1] == "imported:", arguments


def test_the_package_itself_imports_nothing_heavy() -> None:
    script = f"import sys, boxwright; print([name for name in {HEAVY!r} if name in sys.modules])"
    answer = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout
    assert answer.strip() == "[]"
