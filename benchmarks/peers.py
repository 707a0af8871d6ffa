"""Reading a frame, beside the least that numpy can do; run by bench.py. Peers of the plane stage: front_end.py."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.io.clouds import read_cloud


@dataclass(frozen=True)
class Peer:
    """Measures a step on clouds."""

    name: str
    run: Callable[[Path], NDArray[np.float32]]

    def measure(self, clouds: list[Path]) -> str:
        """Median CPU milliseconds, and how many points the last run read."""
        times, points = [], np.empty((0, 3), np.float32)
        for cloud in clouds:
            start = time.process_time()
            points = self.run(cloud)
            times.append(1000 * (time.process_time() - start))
        return f"{np.median(times):9.1f} ms   {len(points)} points"


def own_read(path: Path) -> NDArray[np.float32]:
    return read_cloud(path).points


def numpy_read(path: Path) -> NDArray[np.float32]:
    """x, y, z of a binary PCD that is known to hold four 4-byte fields."""
    content = path.read_bytes()
    start = content.index(b"DATA binary\n") + len(b"DATA binary\n")
    return np.ascontiguousarray(np.frombuffer(content, np.float32, offset=start).reshape(-1, 4)[:, :3])


PEERS = (
    Peer("boxwright: read PCD", own_read),
    Peer("numpy: read PCD, layout known", numpy_read),
)
