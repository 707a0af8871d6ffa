"""The plane front end beside peers: recall and precision on every true plane, CPU time, memory. Markdown tables.

    python benchmarks/front_end.py [--frames N] [--repeats R] [--peer-frames N] [--only METHOD...] [--list-missed]
    python benchmarks/front_end.py --growth N

Frames are simulated, of a seed that no weights and no parameters were made on, the six categories in turn. Everybody
runs on one thread in a process of its own; times are of that process's CPU clock, a frame's is its best of R repeats,
reading the file is not in it. How planes are scored: planes/score.py. What is not installed is said to be absent.
"""

from __future__ import annotations

import argparse
import os
import platform
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from machine import cpu_name
from planes.frames import Sample, hd_camera, make_fused, make_samples
from planes.methods import METHODS, OURS, Method, program_of
from planes.report import SUMMARY, markdown, milliseconds, missed, recall, role_rows, summary_row
from planes.runs import Run, memory, run
from planes.score import MIN_READINGS

from boxwright.simulation.frames import kinect_camera

SEED = 31001
HD_FRAMES = 12
FUSED_CLOUDS = 3
FUSED_READINGS = 1_000_000


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=102, help="VGA frames")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each frame; slow peers have one")
    parser.add_argument("--peer-frames", type=int, default=12, help="the first so many frames are for slow peers")
    parser.add_argument("--seed", type=int, default=SEED, help="of the frames")
    parser.add_argument("--only", nargs="+", choices=[method.key for method in METHODS], help="these methods alone")
    parser.add_argument("--vga-only", action="store_true", help="no larger clouds, no memory")
    parser.add_argument("--list-missed", action="store_true", help="panels that our ways miss")
    parser.add_argument("--growth", type=int, metavar="N", help="memory growth over N frames alone")
    wanted = parser.parse_args()
    chosen = [method for method in METHODS if wanted.only is None or method.key in wanted.only]
    with tempfile.TemporaryDirectory() as folder:
        samples = make_samples(Path(folder) / "vga", wanted.frames, wanted.seed, kinect_camera())
        print_machine(wanted.seed)
        if wanted.growth:
            print_growth(chosen, wanted.growth, samples)
            return
        runs = run_all(chosen, samples, wanted.repeats, wanted.peer_frames)
        print_roles(chosen, runs)
        if not wanted.vga_only:
            print_sizes(chosen, Path(folder), wanted.seed, wanted.repeats)
            print_memory(chosen, samples)
    if wanted.list_missed:
        for method in chosen:
            if method.key in OURS and method.key in runs:
                print(f"\n{method.name}", *missed(runs[method.key].scores), sep="\n")


def print_machine(seed: int) -> None:
    system = f"{platform.system()} {platform.machine()}, {os.cpu_count()} cores"
    print(f"{cpu_name()}, {system}, Python {platform.python_version()}; one thread; seed {seed}")


def run_all(chosen: Sequence[Method], samples: list[Sample], repeats: int, peer_frames: int) -> dict[str, Run]:
    """Runs and prints the table of every method that is there."""
    rows, runs = [], {}
    for method in chosen:
        program, why_not = program_of(method)
        if program is None:
            rows.append([method.name, f"not measured: {why_not}", *[""] * (len(SUMMARY) - 2)])
            continue
        print(f"{method.name} ...", file=sys.stderr, flush=True)
        subset = samples[:peer_frames] if method.slow else samples
        runs[method.key] = run(program, method.key, 1 if method.slow else repeats, subset)
        rows.append(summary_row(method.name, runs[method.key].times, runs[method.key].scores))
    panels = max((recall(found.scores, paired=True)[1] for found in runs.values()), default=0)
    print(f"\n{len(samples)} frames 640 x 480, {panels} panels of at least {MIN_READINGS} readings\n")
    print(markdown(SUMMARY, rows))
    return runs


def print_roles(chosen: Sequence[Method], runs: dict[str, Run]) -> None:
    """Recall by role of the methods that saw all frames."""
    columns = {method.name: runs[method.key].scores for method in chosen if method.key in runs and not method.slow}
    if columns:
        print("\n" + markdown(["panels found", *columns], role_rows(columns)))


def print_sizes(chosen: Sequence[Method], folder: Path, seed: int, repeats: int) -> None:
    """Our times on larger clouds."""
    ways = [method for method in chosen if method.key in OURS and program_of(method)[0]]
    if not ways:
        return
    larger = {
        "organized, 1280 x 720": make_samples(folder / "hd", HD_FRAMES, seed, hd_camera()),
        "unorganized, 1 000 000 points": make_fused(folder / "fused", FUSED_CLOUDS, seed, FUSED_READINGS),
    }
    rows = []
    for name, samples in larger.items():
        for method in ways:
            try:
                times = run(program_of(method)[0] or [], method.key, repeats, samples).times
            except RuntimeError as error:
                rows.append([name, method.name, str(len(samples)), str(error).splitlines()[-1], ""])
                continue
            rows.append([name, method.name, str(len(samples)), *milliseconds(times)])
    print("\n" + markdown(["cloud", "method", "clouds", "CPU ms, median", "99th"], rows))


def print_memory(chosen: Sequence[Method], samples: list[Sample], count: int = 6) -> None:
    """The peak of a fresh process over one frame, beyond that frame."""
    rows = []
    for method in chosen:
        if method.key in OURS and program_of(method)[0]:
            peaks = [memory(method.key, 0, [sample]) for sample in samples[:count]]
            most = [peak["peak_mb"] for peak in peaks]
            frame_mb = f"{peaks[0]['frame_mb']:.1f}"
            rows.append([method.name, str(len(most)), frame_mb, f"{np.median(most):.1f}", f"{max(most):.1f}"])
    if rows:
        heading = ["memory of a fresh process", "frames", "the frame itself, MB", "peak beyond it, MB, median", "most"]
        print("\n" + markdown(heading, rows))


def print_growth(chosen: Sequence[Method], count: int, samples: list[Sample]) -> None:
    """RSS after `count` frames less that after the first round."""
    for method in chosen:
        if method.key in OURS and program_of(method)[0]:
            grown = memory(method.key, count, samples[:36])["grown_mb"]
            print(f"{method.name}: grown by {grown:.1f} MB over {count} frames, after {len(samples[:36])} to warm up")


if __name__ == "__main__":
    main()
