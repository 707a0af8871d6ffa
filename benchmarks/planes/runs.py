"""Runs a way of finding planes on samples, in a process of its own on one thread, and collects its times and labels."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from planes.frames import Sample
from planes.score import FrameScore, score_frame

BENCHMARKS = Path(__file__).resolve().parents[1]
ONE_THREAD = {f"{pool}_NUM_THREADS": "1" for pool in ("RAYON", "OMP", "OPENBLAS", "MKL", "TBB")}


@dataclass(frozen=True)
class Run:
    """Of each sample the CPU milliseconds of its best repeat; scores of those that have a truth."""

    times: list[float]
    scores: list[FrameScore]


def python_program(module: str) -> list[str]:
    return [sys.executable, "-m", f"planes.{module}"]


def run(program: Sequence[str], method: str, repeats: int, samples: Sequence[Sample]) -> Run:
    """All samples of one size. Raises RuntimeError with what the program said where it fails."""
    width, height = samples[0].width, samples[0].height
    with tempfile.TemporaryDirectory() as folder:
        paths = [str(sample.path) for sample in samples]
        lines = child([*program, method, str(width), str(height), str(repeats), folder, *paths])
        scores = [
            score_frame(sample.truth, sample.faces, np.fromfile(Path(folder) / f"{sample.path.stem}.i32", np.int32))
            for sample in samples
            if sample.truth is not None and sample.faces is not None
        ]
    return Run([min(line["cpu_ms"]) for line in lines], scores)


def memory(planes: str, count: int, samples: Sequence[Sample]) -> dict[str, float]:
    """See planes/memory.py."""
    size = [str(samples[0].width), str(samples[0].height)]
    paths = [str(sample.path) for sample in samples]
    told: dict[str, float] = child([*python_program("memory"), planes, *size, str(count), *paths])[0]
    return told


def child(command: list[str]) -> list[dict[str, Any]]:
    """Its lines of JSON."""
    environment = os.environ | ONE_THREAD | {"PYTHONPATH": str(BENCHMARKS)}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{' '.join(command[:4])}: exit status {done.returncode}\n{done.stderr.strip()}")
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
