"""Builds benchmarks/pcl against the system's PCL."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from planes.runs import BENCHMARKS

BUILD = BENCHMARKS.parent / "target" / "pcl"
ABSENT = "PCL is not installed (Debian: libpcl-dev, cmake)"


def build_pcl() -> tuple[Path | None, str]:
    """The program, or None and why there is none."""
    if shutil.which("cmake") is None:
        return None, ABSENT
    configured = _cmake("-S", str(BENCHMARKS / "pcl"), "-B", str(BUILD))
    if configured.returncode:
        return None, ABSENT if "PCL" in configured.stderr and "find" in configured.stderr else _last(configured)
    built = _cmake("--build", str(BUILD))
    return (None, _last(built)) if built.returncode else (BUILD / "pcl_planes", "")


def _cmake(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["cmake", *arguments], capture_output=True, text=True, check=False)


def _last(done: subprocess.CompletedProcess[str]) -> str:
    lines = [line for line in (done.stderr or done.stdout).splitlines() if line.strip()]
    return f"cmake failed: {lines[-1].strip() if lines else 'no message'}"
