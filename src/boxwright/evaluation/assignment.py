"""One-to-one assignment of objects to boxes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def assign(shared: NDArray[np.int64]) -> dict[int, int]:
    """The one-to-one assignment {row: column} with the greatest sum of shared points (rows, columns); exact.

    Pairs that share nothing are not assigned. Ties go to the assignment that keeps earlier rows on earlier columns.
    Sets of taken columns are enumerated: made for frames with a handful of boxes (time 2^columns x rows x columns).
    """
    best: dict[int, tuple[int, dict[int, int]]] = {0: (0, {})}
    for row in range(shared.shape[0]):
        extended = dict(best)
        for taken, (total, pairs) in best.items():
            for column in np.flatnonzero(shared[row]):
                if taken & (1 << int(column)):
                    continue
                key, value = taken | (1 << int(column)), total + int(shared[row, column])
                if key not in extended or value > extended[key][0]:
                    extended[key] = (value, {**pairs, row: int(column)})
        best = extended
    return max(best.values(), key=lambda found: found[0])[1]
