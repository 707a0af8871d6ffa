"""toulbar2 on the score tables of a problem, where pytoulbar2 is installed (`pip install pytoulbar2`)."""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray
from pytoulbar2 import CFN

DECIMALS = 6
"""toulbar2 counts in whole units; its costs are rounded to this many decimals."""

TOO_MUCH = 1000.0
"""Above the cost of every assignment: what may not be."""


def best_score(
    own: NDArray[np.float64], pairs: list[tuple[int, int]], tied: NDArray[np.float64]
) -> tuple[float, list[int], float]:
    """The score of toulbar2's optimum, its states, and its solver's processor seconds, without building the network.

    Arguments are those of `Problem.score_tables`. "Each segment once" stands in a table for each two parts: toulbar2
    takes longer with its all-different constraint.
    """
    network = CFN(TOO_MUCH, DECIMALS)
    parts, states = own.shape
    for part in range(parts):
        network.AddVariable(f"part{part}", range(states))
        network.AddFunction([f"part{part}"], (-own[part]).tolist())
    table_of = dict(zip(pairs, tied, strict=True))
    for second in range(parts):
        for first in range(second):
            gains = np.zeros((states, states))
            gains += table_of.get((first, second), 0.0)
            if (second, first) in table_of:
                gains += table_of[second, first].T
            costs = -gains
            costs[np.arange(1, states), np.arange(1, states)] = TOO_MUCH
            network.AddFunction([f"part{first}", f"part{second}"], costs.ravel().tolist())
    start = time.process_time()
    solution = network.Solve()
    seconds = time.process_time() - start
    if solution is None:
        raise RuntimeError("toulbar2 found no assignment")
    return -float(solution[1]), [int(state) for state in solution[0]], seconds
