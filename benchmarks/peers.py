"""What a user would write with numpy, scipy or Open3D instead of single steps; run by bench.py.

They do less than the steps beside them: no base within the ground's tolerance, no filter, no tolerance that grows
with depth. Their times say what the scale is, no more.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from boxwright.io.clouds import read_cloud
from boxwright.perception import perceive

INLIER_M = 0.01
SMALLEST_PLANE = 500
MOST_PLANES = 10
TRIPLES = 200


@dataclass(frozen=True)
class Peer:
    """Measures a step on clouds; needs a package that may not be there."""

    name: str
    run: Callable[[Path], str]
    package: str = "numpy"

    def measure(self, clouds: list[Path]) -> str:
        """Median CPU milliseconds, and what the last run said."""
        if importlib.util.find_spec(self.package) is None:
            return f"not measured: {self.package} is not installed"
        times, said = [], ""
        for cloud in clouds:
            start = time.process_time()
            said = self.run(cloud)
            times.append(1000 * (time.process_time() - start))
        return f"{np.median(times):9.1f} ms   {said}"


def numpy_read(path: Path) -> NDArray[np.float32]:
    """x, y, z of a binary PCD that is known to hold four 4-byte fields."""
    content = path.read_bytes()
    start = content.index(b"DATA binary\n") + len(b"DATA binary\n")
    return np.ascontiguousarray(np.frombuffer(content, np.float32, offset=start).reshape(-1, 4)[:, :3])


def numpy_planes(path: Path) -> str:
    """Sequential RANSAC of all readings in numpy, hulls by scipy."""
    points = numpy_read(path)
    left = points[np.isfinite(points).all(axis=1)].astype(np.float64)
    rng = np.random.default_rng(0)
    hulls = 0
    for _ in range(MOST_PLANES):
        inliers = _largest_plane(left, rng)
        if inliers.sum() < SMALLEST_PLANE:
            break
        hulls += _has_hull(left[inliers])
        left = left[~inliers]
    return f"{hulls} planes in the last frame"


def _largest_plane(points: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.bool_]:
    best = np.zeros(len(points), bool)
    for a, b, c in points[rng.integers(len(points), size=(TRIPLES, 3))]:
        normal = np.cross(b - a, c - a)
        length = np.linalg.norm(normal)
        if length > 1e-9:
            inliers = np.abs((points - a) @ (normal / length)) < INLIER_M
            best = inliers if inliers.sum() > best.sum() else best
    return best


def _has_hull(points: NDArray[np.float64]) -> bool:
    centred = points - points.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1][:, 1:]
    try:
        return len(ConvexHull(centred @ axes).vertices) > 2
    except QhullError:
        return False


def open3d_planes(path: Path) -> str:
    """The chain of Open3D's tutorials: a plane by RANSAC, what is left by DBSCAN."""
    import open3d

    cloud = open3d.io.read_point_cloud(str(path)).remove_non_finite_points()
    _, ground = cloud.segment_plane(INLIER_M, 3, TRIPLES)
    rest = cloud.select_by_index(ground, invert=True)
    return f"{np.max(rest.cluster_dbscan(0.02, 20)) + 1} clusters in the last frame"


def own_read(path: Path) -> str:
    return f"{len(read_cloud(path).points)} points"


def own_planes(path: Path) -> str:
    return f"{len(perceive(read_cloud(path)))} segments in the last frame"


def peer_read(path: Path) -> str:
    return f"{len(numpy_read(path))} points"


PEERS = (
    Peer("boxwright: read PCD", own_read),
    Peer("numpy: read PCD, layout known", peer_read),
    Peer("boxwright: read, support, clusters, planes, rectangles", own_planes),
    Peer("numpy + scipy: read, sequential RANSAC, hulls", numpy_planes),
    Peer("Open3D: read, ground by RANSAC, DBSCAN", open3d_planes, package="open3d"),
)
