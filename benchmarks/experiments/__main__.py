"""Runs experiments: python -m benchmarks.experiments [NAME...] [--quick] [--out FOLDER] [--jobs N]

Without names all of them run, in the order of the list that --help shows. Same tables each time, but for times.
"""

from __future__ import annotations

import argparse
import shlex
import sys
import time
from pathlib import Path

from benchmarks.experiments import (
    chain,
    closing,
    conditions,
    keep_fraction,
    left_out,
    plane_stage,
    search_cost,
    table_one,
    training_size,
)
from benchmarks.experiments.lab import Lab
from benchmarks.experiments.report import write

from boxwright.parallel import processors

EXPERIMENTS = {
    "table_one": table_one,
    "keep_fraction": keep_fraction,
    "search_cost": search_cost,
    "left_out": left_out,
    "chain": chain,
    "training_size": training_size,
    "conditions": conditions,
    "plane_stage": plane_stage,
    "closing": closing,
}
RESULTS = Path(__file__).parents[2] / "docs" / "results"


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(EXPERIMENTS)}; default: all")
    parser.add_argument("--quick", action="store_true", help="tiny sizes: that it runs, not what is true")
    parser.add_argument("--out", type=Path, help="folder of the files; default: docs/results, with --quick out/results")
    parser.add_argument("--jobs", type=int, default=processors(), help="threads; they change no figure but times")
    options = parser.parse_args()
    unknown = [name for name in options.names if name not in EXPERIMENTS]
    if unknown:
        parser.error(f"{', '.join(unknown)}: no such experiment; there are {', '.join(EXPERIMENTS)}")
    folder = options.out or (Path("out/results") if options.quick else RESULTS)
    lab = Lab(quick=options.quick, jobs=options.jobs)
    began = time.perf_counter()
    for name in options.names or EXPERIMENTS:
        start = time.perf_counter()
        command = shlex.join(["python", "-m", "benchmarks.experiments", name, *(["--quick"] if options.quick else [])])
        write(EXPERIMENTS[name].run(lab), name, folder, command)
        print(f"{name}: {time.perf_counter() - start:.0f} s -> {folder / name}.md", flush=True)
    print(f"all: {time.perf_counter() - began:.0f} s on {options.jobs} threads", file=sys.stderr)


if __name__ == "__main__":
    main()
