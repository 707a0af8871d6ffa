"""Where a cloud is looked at from: the camera's own image, or a made-up camera for an unorganized cloud."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright.perception import Perception
from boxwright.types import Cloud

Array = NDArray[np.float64]

PINHOLE_RMS_PX = 2.0
"""An organized cloud whose points are farther from their pixels than this is no pinhole camera's image."""

NEAREST_M = 0.01
"""What is nearer to the camera's plane is not drawn."""

SIZE = (640, 480)
"""Columns and rows of a made-up camera's image."""

ELEVATION_RAD = np.radians(38.0)
"""A made-up camera looks down by this: it sees into boxes and still sees their sides."""

EYE_DISTANCE_RADII = 3.0
"""How far a made-up camera stands off, in radii of what it looks at."""


@dataclass(frozen=True, eq=False)
class View:
    """An image of a cloud: `index` (rows, columns) is the point in each pixel, -1 none; `projection` (3, 4) goes from
    homogeneous coordinates of the input's frame to pixels; `eye` is the camera's place. In the camera's own image pixel
    (u, v) is point v * width + u, with or without a reading."""

    index: NDArray[np.int64]
    projection: Array
    eye: Array
    is_camera_image: bool

    def has_before_it(self, points: Array) -> bool:
        """Whether all points (N, 3) lie in front of the camera; others have no pixel."""
        return bool(np.all(points @ self.projection[2, :3] + self.projection[2, 3] > NEAREST_M))

    def project(self, points: Array) -> Array:
        """Pixels (N, 2), u and v, of points (N, 3) that lie in front of the camera."""
        homogeneous = points @ self.projection[:, :3].T + self.projection[:, 3]
        pixels: Array = homogeneous[:, :2] / homogeneous[:, 2:]
        return pixels

    def distance(self, points: Array) -> Array:
        """Metres (N,) from the eye to points (N, 3)."""
        return np.asarray(np.linalg.norm(points - self.eye, axis=1), np.float64)


def view_of(cloud: Cloud, perception: Perception) -> View:
    """The camera's own image where the cloud is one, else one from above at an angle."""
    return _camera_image(cloud) or _from_above(cloud, perception)


def _camera_image(cloud: Cloud) -> View | None:
    """The image that an organized cloud is, its intrinsics fitted to its points; None where no pinhole explains it."""
    if not cloud.organized:
        return None
    index = np.arange(len(cloud.points)).reshape(cloud.height, cloud.width)
    valid = np.flatnonzero(np.isfinite(cloud.points).all(axis=1) & (cloud.points[:, 2] != 0.0))
    if len(valid) < 3:
        return None
    x, y, z = cloud.points[valid].astype(np.float64).T
    focal_u, centre_u, error_u = _line(x / z, valid % cloud.width)
    focal_v, centre_v, error_v = _line(y / z, valid // cloud.width)
    if max(error_u, error_v) > PINHOLE_RMS_PX:
        return None
    projection = np.array([[focal_u, 0, centre_u, 0], [0, focal_v, centre_v, 0], [0, 0, 1, 0]], np.float64)
    # A camera of the opengl kind looks along -z; depths in front of it are to be positive.
    projection *= np.sign(np.median(z))
    seen = np.isfinite(cloud.points).all(axis=1).reshape(index.shape)
    return View(np.where(seen, index, -1), projection, np.zeros(3), is_camera_image=True)


def _line(x: Array, y: NDArray[np.int64]) -> tuple[float, float, float]:
    """Slope, offset and rms error of the line y = slope x + offset by least squares."""
    spread = x - x.mean()
    slope = float(spread @ (y - y.mean()) / max(float(spread @ spread), 1e-300))
    offset = float(y.mean() - slope * x.mean())
    return slope, offset, float(np.sqrt(np.mean((slope * x + offset - y) ** 2)))


def _from_above(cloud: Cloud, perception: Perception) -> View:
    """A made-up camera, turned to what perception segmented, on the side where the sensor may have stood."""
    points = cloud.points.astype(np.float64)
    valid = np.isfinite(points).all(axis=1)
    subject = points[valid & (perception.labels >= 0)] if len(perception) else points[valid]
    centre = np.median(subject, axis=0)
    radius = max(float(np.percentile(np.linalg.norm(subject - centre, axis=1), 98)), 1e-3)
    towards_eye = _towards_eye(cloud, centre, perception.up, points[valid])
    rotation = _looking(-towards_eye, perception.up)
    eye = centre + EYE_DISTANCE_RADII * radius * towards_eye
    focal = 0.45 * SIZE[1] * EYE_DISTANCE_RADII
    intrinsics = np.array([[focal, 0, SIZE[0] / 2], [0, focal, SIZE[1] / 2], [0, 0, 1]], np.float64)
    projection = intrinsics @ np.column_stack([rotation, -rotation @ eye])
    return View(_splat(points, np.flatnonzero(valid), projection), projection, eye, is_camera_image=False)


def _towards_eye(cloud: Cloud, centre: Array, up: Array, points: Array) -> Array:
    """Unit vector from the subject to the camera."""
    if cloud.viewpoint is not None:
        towards = np.array(cloud.viewpoint) - centre
        return np.asarray(towards / np.linalg.norm(towards), np.float64)
    # Most clouds keep their sensor at the origin. Only the picture depends on it.
    outside = np.any((points.min(axis=0) > 0.0) | (points.max(axis=0) < 0.0))
    aside = -centre if outside else np.array([0.6, -0.8, 0.2])
    level = aside - (aside @ up) * up
    if np.linalg.norm(level) < 1e-6:
        level = np.linalg.svd(up[None, :])[2][1]
    level /= np.linalg.norm(level)
    return np.asarray(np.cos(ELEVATION_RAD) * level + np.sin(ELEVATION_RAD) * up, np.float64)


def _looking(forward: Array, up: Array) -> Array:
    """camera_from_input rotation (3, 3) of an optical frame that looks forward with `up` upwards in the image."""
    right = np.cross(forward, up)
    if np.linalg.norm(right) < 1e-6:
        right = np.linalg.svd(forward[None, :])[2][1]
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(forward, right), forward])


def _splat(points: Array, valid: NDArray[np.int64], projection: Array) -> NDArray[np.int64]:
    """The point in each pixel (rows, columns), nearest first, each as a dot that closes the gaps; -1 for none."""
    homogeneous = points[valid] @ projection[:, :3].T + projection[:, 3]
    before = homogeneous[:, 2] > 0.0
    valid, homogeneous = valid[before], homogeneous[before]
    far_to_near = np.argsort(-homogeneous[:, 2], kind="stable")
    pixels = np.rint(homogeneous[far_to_near, :2] / homogeneous[far_to_near, 2:]).astype(np.int64)
    reach = 1 if len(valid) > 40_000 else 2
    steps = np.arange(-reach, reach + 1)
    offsets = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    dots = (pixels[:, None, :] + offsets).reshape(-1, 2)
    owners = np.repeat(valid[far_to_near], len(offsets))
    inside = np.all((dots >= 0) & (dots < SIZE), axis=1)
    index = np.full(SIZE[::-1], -1, np.int64)
    index[dots[inside, 1], dots[inside, 0]] = owners[inside]
    return index
