"""Segments raw frames in a process of its own, as pcl_planes does: METHOD WIDTH HEIGHT REPEATS OUT FRAME...

Each FRAME.f32 is loaded once and segmented REPEATS times; OUT/FRAME.i32 gets the labels, standard output a line of JSON
with the CPU milliseconds of each repeat. One more run beforehand, of the first frame, is not told.
"""

from __future__ import annotations

import json
import sys
import time
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from planes import open3d_chains
from planes.ours import PLANES, labels_of

OPEN3D = {
    "open3d": open3d_chains.chain,
    "open3d-voxels": open3d_chains.voxel_chain,
    "open3d-patches": open3d_chains.patches,
}


def segment(method: str, points: NDArray[np.float32], width: int, height: int) -> NDArray[np.int32]:
    if method in PLANES:
        return labels_of(points, width, height, method)
    return OPEN3D[method](points)


def main() -> None:
    method, width, height, repeats = sys.argv[1], *map(int, sys.argv[2:5])
    out, frames = Path(sys.argv[5]), [Path(name) for name in sys.argv[6:]]
    for number, frame in enumerate(frames):
        points = np.fromfile(frame, np.float32).reshape(-1, 3)
        if number == 0 and method in PLANES:
            segment(method, points, width, height)
        times = []
        for _ in range(repeats):
            start = time.process_time()
            labels = segment(method, points, width, height)
            times.append(1000 * (time.process_time() - start))
        np.asarray(labels, np.int32).tofile(out / f"{frame.stem}.i32")
        print(json.dumps({"frame": frame.stem, "cpu_ms": times}), flush=True)


if __name__ == "__main__":
    main()
