"""Memory of a process that finds planes: PLANES WIDTH HEIGHT COUNT FRAME...

COUNT 0: what one frame needs at its peak beyond the process with that frame loaded. Else: by how much the process has
grown after COUNT frames, the given ones in turn, from when each had been seen once. Prints a line of JSON, MB.
"""

from __future__ import annotations

import json
import sys
from itertools import cycle, islice
from pathlib import Path

import numpy as np

from planes.ours import labels_of

STATUS = Path("/proc/self/status")
FORGET_PEAK = "5"
"""Written to clear_refs, it sets the peak to what is held now (proc(5))."""


def held_mb(key: str) -> float:
    """VmRSS or VmHWM of this process."""
    return int(next(line for line in STATUS.read_text().splitlines() if line.startswith(key)).split()[1]) / 1024


def main() -> None:
    planes, width, height, count = sys.argv[1], *map(int, sys.argv[2:5])
    frames = [np.fromfile(name, np.float32).reshape(-1, 3) for name in sys.argv[5:]]
    for points in frames if count else ():
        labels_of(points, width, height, planes)
    Path("/proc/self/clear_refs").write_text(FORGET_PEAK)
    before = held_mb("VmRSS:")
    for points in islice(cycle(frames), max(count, 1)):
        labels_of(points, width, height, planes)
    after = held_mb("VmRSS:")
    told = {"frame_mb": frames[0].nbytes / 2**20, "peak_mb": held_mb("VmHWM:") - before, "grown_mb": after - before}
    print(json.dumps(told))


if __name__ == "__main__":
    main()
