"""The child process of bench.py: answers frames and tells what they took, a line of JSON each.

Run by bench.py, which sets the number of threads:
one_thread.py times METHOD REPEATS CLOUD... | one_thread.py peak METHOD CLOUD
"""

from __future__ import annotations

import json
import sys
import time

from machine import peak_memory_mb

from boxwright.io.clouds import read_cloud
from boxwright.pipeline import infer


def main() -> None:
    if sys.argv[1] == "peak":
        infer(read_cloud(sys.argv[3]), method=sys.argv[2])
        print(json.dumps({"peak_mb": peak_memory_mb()}))
        return
    method, repeats, clouds = sys.argv[2], int(sys.argv[3]), sys.argv[4:]
    run(clouds[0], method)
    for cloud in clouds:
        runs = (run(cloud, method) for _ in range(repeats))
        print(json.dumps(min(runs, key=lambda times: times["cloud to model, CPU"])))


def run(cloud_path: str, method: str) -> dict[str, float]:
    """Milliseconds: stages by the wall clock, as model.json tells them; the whole by the wall clock and in CPU time."""
    wall, cpu = time.perf_counter(), time.process_time()
    cloud = read_cloud(cloud_path)
    read_wall, read_cpu = time.perf_counter() - wall, time.process_time() - cpu
    cpu = time.process_time()
    model = infer(cloud, method=method).model
    infer_cpu = time.process_time() - cpu
    seconds = {
        "read PCD (binary)": read_wall,
        "read PCD (binary), CPU": read_cpu,
        **model.seconds.stages,
        "cloud to model": model.seconds.total,
        "cloud to model, CPU": infer_cpu,
    }
    return {stage: 1000 * value for stage, value in seconds.items()}


if __name__ == "__main__":
    main()
