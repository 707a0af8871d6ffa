"""From a cloud to its planar segments as a record; and what every way through says of a cloud."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.perception import Perception, perceive
from boxwright.types import Cloud, Seconds, Segment, Segmentation, Source, SupportPlane
from boxwright.types.truth import Vector

Bounds = tuple[float, float, float, float, float, float]
"""x low, x high, y low, y high, z low, z high in metres, the cloud's own frame."""


@dataclass(frozen=True)
class Segmented:
    """A cloud's segments, as a record and as perception saw them."""

    segmentation: Segmentation
    perception: Perception


def segment(
    cloud: Cloud,
    *,
    up: tuple[float, float, float] | None = None,
    roi: Bounds | None = None,
    planes: str | None = None,
    read_seconds: float = 0.0,
) -> Segmented:
    """Finds the planar segments of a cloud.

    `up` is the direction away from the support, in the cloud's frame, where it is known. `roi` leaves out all points
    beyond the bounds. `planes` names the front end, one of `_core.PLANES`. Metres, the cloud's frame.

    Raises ValueError where a value does not fit or the cloud cannot be used as it is (units, frame, up), with the mend.
    """
    start = time.perf_counter()
    kept = cloud if roi is None else msgspec.structs.replace(cloud, points=within(cloud.points, roi))
    perception = perceive(kept, up=up, planes=planes)
    segments = _segments(perception)
    total = time.perf_counter() - start
    segmentation = Segmentation(
        format="boxwright.segments",
        version=1,
        source=source_of(cloud),
        warnings=tuple(perception.warnings),
        seconds=Seconds(read=read_seconds, stages=perception.stage_seconds, total=total),
        up=vector(perception.up),
        support_plane=support_plane_of(perception),
        segments=segments,
    )
    return Segmented(segmentation, perception)


def within(points: NDArray[np.float32], roi: Bounds) -> NDArray[np.float32]:
    """A copy of the points (N, 3) in which those beyond the bounds are no readings (NaN).

    Raises ValueError where a low bound is not below its high one, and where readings are and none lies within.
    """
    return np.where(inside(points, roi)[:, None], points, np.float32(np.nan))


def inside(points: NDArray[np.floating], roi: Bounds) -> NDArray[np.bool_]:
    """Which of the points (N, 3) lie within the bounds.

    Raises ValueError where a low bound is not below its high one, and where readings are and none lies within.
    """
    low, high = np.array(roi[0::2]), np.array(roi[1::2])
    if not np.all(low < high):
        raise ValueError(
            f"roi {','.join(map(str, roi))}: each low bound comes before its high one: xlo,xhi,ylo,yhi,zlo,zhi"
        )
    kept = np.asarray(np.all((points >= low) & (points <= high), axis=1))
    if not kept.any():
        _refuse_empty(points, roi)
    return kept


def _refuse_empty(points: NDArray[np.floating], roi: Bounds) -> None:
    """A region beside all readings is a mistake; a cloud without any is refused elsewhere, as what it is."""
    readings = points[np.isfinite(points).all(axis=1)]
    if len(readings):
        spans = zip("xyz", readings.min(axis=0), readings.max(axis=0), strict=True)
        where = ", ".join(f"{axis} {low:.3f} to {high:.3f}" for axis, low, high in spans)
        raise ValueError(f"roi {','.join(map(str, roi))}: holds no reading; the cloud's readings lie in {where} m")


def source_of(cloud: Cloud) -> Source:
    """Where an answer comes from."""
    file = Path(cloud.path).name if cloud.path else ""
    return Source(file=file, points=len(cloud.points), organized=cloud.organized)


def support_plane_of(perception: Perception) -> SupportPlane | None:
    """The plane that things stand on, None where the cloud shows none."""
    plane = perception.support_plane
    return None if plane is None else SupportPlane(normal=vector(plane[0]), distance=float(plane[1]))


def vector(values: NDArray[np.float64]) -> Vector:
    """Three numbers (3,) as a record has them."""
    x, y, z = (float(v) for v in values)
    return x, y, z


def size_m(segment: Segment) -> tuple[float, float]:
    """Lengths of the first and second side of a segment's rectangle, metres."""
    a, b, c, _ = segment.rectangle
    return math.dist(a, b), math.dist(b, c)


def tilt_deg(segment: Segment, up: Vector) -> float:
    """How a segment leans, from level, 0, to upright, 90."""
    along = abs(sum(n * u for n, u in zip(segment.normal, up, strict=True)))
    return math.degrees(math.acos(min(along, 1.0)))


def _segments(seen: Perception) -> tuple[Segment, ...]:
    rows = zip(
        seen.normals, seen.distances, seen.rms, seen.point_counts, seen.rectangles, seen.edges, seen.hulls,
        seen.groups, strict=True,
    )  # fmt: skip
    return tuple(
        Segment(
            normal=vector(normal),
            distance=float(distance),
            rms=float(rms),
            points=int(points),
            rectangle=(vector(corners[0]), vector(corners[1]), vector(corners[2]), vector(corners[3])),
            edges=edges,
            hull=tuple(vector(corner) for corner in hull),
            group=int(group),
        )
        for normal, distance, rms, points, corners, edges, hull, group in rows
    )
