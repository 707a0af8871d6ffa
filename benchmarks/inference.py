"""The exact search: time by problem on one thread, its share beside the features', and toulbar2 on the same tables.

Run: python benchmarks/inference.py [--count N] [--segments n] [--peer-count N] [--repeats R]
Each problem is solved R times and its fastest run counts; medians and 99th percentiles are taken over the problems.
toulbar2 solves the first of them in the same run, where pytoulbar2 is installed, R times too; its time is its solver's
alone. Times are the processor's, so that other work on the machine counts little.
"""

from __future__ import annotations

import argparse
import importlib.util
import time
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from inference_problems import random_problems, simulated_problems
from machine import cpu_name
from numpy.typing import NDArray

from boxwright import _core
from boxwright.models import load_template, load_weights

SEED = 31001
TEMPLATES = ("carton", "cake_box")
WITHIN = 1e-4
"""Scores differ by no more than toulbar2's rounding of some dozens of tables."""


class Row(NamedTuple):
    """One problem in milliseconds: features (0 for random tables), search; toulbar2 where it was run."""

    features_ms: float
    search_ms: float
    nodes: int
    peer_ms: float | None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=100, help="problems of each kind")
    parser.add_argument("--segments", type=int, default=30, help="segments of each problem")
    parser.add_argument("--peer-count", type=int, default=20, help="problems of each kind that toulbar2 solves too")
    parser.add_argument("--repeats", type=int, default=5, help="runs of each problem")
    wanted = parser.parse_args()
    print(f"{cpu_name()}, one thread; {wanted.count} problems of {wanted.segments} segments each, seed {SEED}\n")
    if importlib.util.find_spec("pytoulbar2") is None:
        print("toulbar2 is not measured: pytoulbar2 is not installed\n")
    print(
        "| problems | median ms | p99 ms | nodes, median | features, median ms | toulbar2, median ms | times slower |"
    )
    print("|---|---|---|---|---|---|---|")
    for name in TEMPLATES:
        template = load_template(name)
        ones = np.ones(len(template.feature_names) + len(template.relation_names))
        drawn = random_problems(template, wanted.segments, wanted.count, SEED)
        print_rows(f"{name}, random", [row(p, None, ones, k, wanted) for k, p in enumerate(drawn)])
        learned = load_weights(name).vector(template)
        seen = simulated_problems(template, wanted.segments, wanted.count, SEED)
        rows = [row(p, measure, learned, k, wanted) for k, (p, measure) in enumerate(seen)]
        print_rows(f"{name}, simulated", rows)


def row(
    problem: _core.Problem,
    measure: Callable[[], _core.Problem] | None,
    weights: NDArray[np.float64],
    number: int,
    wanted: argparse.Namespace,
) -> Row:
    """Measures one problem; fails where toulbar2 knows better."""
    _, scores, status, _, nodes = problem.solve(weights)
    if status != "optimal":
        print(f"problem {number}: not proven within the budget")
    search = least_ms(lambda: problem.solve(weights), wanted.repeats)
    features = least_ms(measure, wanted.repeats) if measure else 0.0
    peer = None
    if number < wanted.peer_count and importlib.util.find_spec("pytoulbar2") is not None:
        from toulbar2_peer import best_score

        tables = problem.score_tables(weights)
        best, _, seconds = min((best_score(*tables) for _ in range(wanted.repeats)), key=lambda solved: solved[2])
        if best > scores[0] + WITHIN:
            raise SystemExit(f"problem {number}: toulbar2 reaches {best}, the exact search {scores[0]}")
        peer = 1000 * seconds
    return Row(features, search, nodes, peer)


def least_ms(work: Callable[[], object], repeats: int) -> float:
    """Processor milliseconds of the fastest of some runs."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return 1000 * min(times)


def print_rows(name: str, rows: list[Row]) -> None:
    search = np.array([r.search_ms for r in rows])
    features = float(np.median([r.features_ms for r in rows]))
    compared = [r for r in rows if r.peer_ms is not None]
    peer = slower = "-"
    if compared:
        peer = f"{np.median([r.peer_ms for r in compared]):.0f}"
        slower = f"{np.median([r.peer_ms / r.search_ms for r in compared]):.0f}"
    nodes = np.median([r.nodes for r in rows])
    measured = f"{features:.2f}" if features else "-"
    print(
        f"| {name} | {np.median(search):.2f} | {np.percentile(search, 99):.2f} | {nodes:.0f}"
        f" | {measured} | {peer} | {slower} |",
        flush=True,
    )


if __name__ == "__main__":
    main()
