"""The pools of many problems in one array, for fits that go over all of them at once."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.learning.pools import AssignmentPool

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Stack:
    """K assignments of P problems; those of problem i are rows starts[i] up to the next start."""

    features: Array
    """(K, terms)."""
    correctness: Array
    log_copies: Array
    is_truth: NDArray[np.bool_]
    starts: NDArray[np.int64]
    shares: Array
    """(P,) what each problem weighs; they sum to 1."""

    @staticmethod
    def of(pools: Sequence[AssignmentPool], shares: Array) -> Stack:
        """All pools, one after another; `shares` (P,) need not sum to 1."""
        lengths = np.array([len(pool) for pool in pools])
        return Stack(
            features=np.concatenate([pool.features for pool in pools]),
            correctness=np.concatenate([pool.correctness for pool in pools]),
            log_copies=np.concatenate([pool.log_copies for pool in pools]),
            is_truth=np.concatenate([pool.most_correct() for pool in pools]),
            starts=np.concatenate([[0], np.cumsum(lengths)[:-1]]),
            shares=shares / shares.sum(),
        )

    def __len__(self) -> int:
        return len(self.starts)

    def rows(self, problem: int) -> slice:
        """Where the assignments of a problem stand."""
        following = self.starts[problem + 1] if problem + 1 < len(self.starts) else len(self.features)
        return slice(int(self.starts[problem]), int(following))

    def spread(self) -> Array:
        """(terms,) root mean square of each term within the problems' assignments, 1 where it is 0 throughout."""
        counts = np.diff([*self.starts, len(self.features)])
        means = np.add.reduceat(self.features**2, self.starts, axis=0) / counts[:, None]
        spread: Array = np.sqrt(self.shares @ means)
        spread[spread == 0.0] = 1.0
        return spread

    def best_correctness(self, weights: Array) -> Array:
        """(P,) correctness of each problem's best assignment; the first of equals."""
        scores = self.features @ weights
        return np.array([self.correctness[r][np.argmax(scores[r])] for r in map(self.rows, range(len(self)))])
