"""What a user of Open3D would write; the chains with the parameters of benchmarks/pcl."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Labels = NDArray[np.int32]

ROOM_M = 0.01
ROOM_SHARE = 0.12
PLANE_M = 0.004
DRAWS = 500
GAP_M = 0.01
NEIGHBOURS = 10
MIN_POINTS = 500
LEAF_M = 0.01
MIN_VOXELS = 20
VOXEL_GAP_M = 0.02
VOXEL_NEIGHBOURS = 4


def chain(points: NDArray[np.float32]) -> Labels:
    """Planes of the room by RANSAC, DBSCAN of the rest, planes by RANSAC in each cluster; all readings."""
    return _chain(points, 0.0, GAP_M, NEIGHBOURS, MIN_POINTS)


def voxel_chain(points: NDArray[np.float32]) -> Labels:
    """The same on 10 mm voxels; each reading gets its voxel's label."""
    return _chain(points, LEAF_M, VOXEL_GAP_M, VOXEL_NEIGHBOURS, MIN_VOXELS)


def patches(points: NDArray[np.float32]) -> Labels:
    """`detect_planar_patches`; a reading belongs to the patch in whose box it lies, the nearest plane of several."""
    import open3d

    is_reading = np.isfinite(points).all(axis=1)
    cloud = _cloud(points[is_reading])
    cloud.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(knn=30))
    found = cloud.detect_planar_patches(
        normal_variance_threshold_deg=20,
        coplanarity_deg=75,
        outlier_ratio=0.75,
        min_plane_edge_length=0.02,
        min_num_points=100,
        search_param=open3d.geometry.KDTreeSearchParamKNN(knn=30),
    )
    readings = np.asarray(cloud.points)
    labels, nearest_m = np.full(len(readings), -1, np.int32), np.full(len(readings), np.inf)
    for k, box in enumerate(found):
        inside = np.asarray(box.get_point_indices_within_bounding_box(cloud.points), dtype=np.int64)
        off_m = np.abs((readings[inside] - box.center) @ box.R[:, 2])
        nearer = inside[off_m < nearest_m[inside]]
        nearest_m[inside] = np.minimum(nearest_m[inside], off_m)
        labels[nearer] = k
    return _spread(labels, is_reading)


def _chain(points: NDArray[np.float32], leaf_m: float, gap_m: float, neighbours: int, least: int) -> Labels:
    import open3d

    open3d.utility.random.seed(0)
    is_reading = np.isfinite(points).all(axis=1)
    cloud = _cloud(points[is_reading])
    voxel_of = np.arange(is_reading.sum())
    if leaf_m:
        cloud, _, members = cloud.voxel_down_sample_and_trace(leaf_m, cloud.get_min_bound(), cloud.get_max_bound())
        for voxel, readings in enumerate(members):
            voxel_of[np.asarray(readings)] = voxel
    labels = np.full(len(cloud.points), -1, np.int32)
    left = _take_planes(cloud, np.arange(len(labels)), ROOM_M, int(ROOM_SHARE * len(labels)), labels)
    if len(left):
        clusters = np.asarray(cloud.select_by_index(left).cluster_dbscan(gap_m, neighbours))
        for k in range(clusters.max(initial=-1) + 1):
            _take_planes(cloud, left[clusters == k], PLANE_M, least, labels, hulls=True)
    return _spread(labels[voxel_of], is_reading)


def _take_planes(
    cloud: Any, left: NDArray[np.int64], within_m: float, least: int, labels: Labels, hulls: bool = False
) -> NDArray[np.int64]:
    """Marks plane after plane of at least so many points; what is left."""
    while len(left) >= max(least, 3):
        _, inliers = cloud.select_by_index(left).segment_plane(within_m, 3, DRAWS)
        if len(inliers) < least:
            break
        labels[left[inliers]] = labels.max(initial=-1) + 1
        if hulls:
            cloud.select_by_index(left[inliers]).compute_convex_hull(joggle_inputs=True)
        left = np.delete(left, inliers)
    return left


def _cloud(points: NDArray[np.float32]) -> Any:
    import open3d

    return open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points.astype(np.float64)))


def _spread(labels: Labels, is_reading: NDArray[np.bool_]) -> Labels:
    """From readings to points."""
    spread = np.full(len(is_reading), -1, np.int32)
    spread[is_reading] = labels
    return spread
