"""From a VGA frame to its model on one thread: time by stage, peak memory, and reading beside numpy's.

Run: python benchmarks/bench.py [--frames N] [--repeats R] [--method fitted|exact|paper]
Each frame is read and inferred R times; of its R runs the one with least CPU time counts, then medians are taken over
the frames. Peak memory is that of a fresh process that answers one frame and ends. Frames are simulated, seed stated.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from machine import cpu_name
from peers import PEERS

HERE = Path(__file__).parent
SEED = 20110
ONE_THREAD = {"RAYON_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
PEAK_FRAMES = 6


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--frames", type=int, default=36, help="simulated frames, the six categories in turn")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each frame")
    parser.add_argument("--method", choices=("fitted", "exact", "paper"), default="fitted", help="of inference")
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        clouds = make_clouds(Path(folder), wanted.frames)
        runs = runs_of(clouds, wanted.repeats, wanted.method)
        peaks = [peak_of(cloud, wanted.method) for cloud in clouds[:PEAK_FRAMES]]
        peers = [(peer.name, peer.measure(clouds[:PEAK_FRAMES])) for peer in PEERS]
    print_machine(len(clouds), wanted.repeats, wanted.method)
    print_stages(runs)
    print_peaks(peaks)
    print_help_time()
    print_peers(peers)


def make_clouds(folder: Path, count: int) -> list[Path]:
    """Simulated frames on disk, in the order of the sequence."""
    from boxwright.simulation import CATEGORIES, write_set

    return [folder / f"{name}.pcd" for name in write_set(folder, count, SEED, CATEGORIES)]


def runs_of(clouds: list[Path], repeats: int, method: str) -> list[dict[str, float]]:
    """Milliseconds by stage of each frame, from one process on one thread, its first frame run once beforehand."""
    return _child("times", method, str(repeats), *map(str, clouds))


def peak_of(cloud: Path, method: str) -> float:
    """Peak resident memory in MB of a fresh process from start to answer."""
    return float(_child("peak", method, str(cloud))[0]["peak_mb"])


def _child(*arguments: str) -> list[dict[str, float]]:
    command = [sys.executable, str(HERE / "one_thread.py"), *arguments]
    done = subprocess.run(command, env=os.environ | ONE_THREAD, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"bench: {' '.join(arguments[:2])} failed:\n{done.stderr}")
    return [json.loads(line) for line in done.stdout.splitlines()]


def print_machine(frames: int, repeats: int, method: str) -> None:
    system = f"{platform.system()} {platform.machine()}"
    print(f"{cpu_name()}, {os.cpu_count()} cores, {system}, Python {platform.python_version()}")
    print(f"{frames} simulated frames 640 x 480, seed {SEED}; one thread; best of {repeats} runs each; method {method}")


def print_stages(runs: list[dict[str, float]]) -> None:
    print(f"\n{'stage':<28}{'median ms':>12}{'p90 ms':>12}{'p99 ms':>12}")
    for stage in runs[0]:
        times = np.percentile([run[stage] for run in runs], [50, 90, 99])
        print(f"{stage:<28}" + "".join(f"{value:>12.1f}" for value in times))


def print_peaks(peaks: list[float]) -> None:
    largest = f"max {max(peaks):.0f} MB, {len(peaks)} frames"
    print(f"\npeak memory of a fresh process, cloud to model: {np.median(peaks):.0f} MB ({largest})")


def print_help_time(tries: int = 7) -> None:
    script = Path(sys.executable).with_name("boxwright")
    wall, before = [], _children_cpu_seconds()
    for _ in range(tries):
        start = time.perf_counter()
        subprocess.run([script, "--help"], check=True, capture_output=True)
        wall.append(time.perf_counter() - start)
    cpu = (_children_cpu_seconds() - before) / tries
    print(f"boxwright --help: {min(wall):.2f} s (best of {tries}, median {np.median(wall):.2f} s), {cpu:.2f} s CPU")


def _children_cpu_seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def print_peers(peers: list[tuple[str, str]]) -> None:
    print(f"\nreading, on {PEAK_FRAMES} of the frames (CPU time, medians)")
    for name, line in peers:
        print(f"  {name:<52}{line}")


if __name__ == "__main__":
    main()
