"""From a cloud to its model: the way through that users call."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.models import TEMPLATE_NAMES, load_object_model
from boxwright.types import Cloud
from boxwright.types.model import Model, Object, Seconds, Source, SupportPlane

METHODS = ("paper",)
"""The ways through that are built."""

DEFAULT_METHOD = "paper"

Bounds = tuple[float, float, float, float, float, float]
"""x low, x high, y low, y high, z low, z high in metres, the cloud's own frame."""


@dataclass(frozen=True)
class Inferred:
    """The answer to one cloud: the model, and for each point (N,) its object and part, int16, -1 for none."""

    model: Model
    object_labels: NDArray[np.int16]
    part_labels: NDArray[np.int16]
    perception: _core.Perception


def infer(
    cloud: Cloud,
    *,
    method: str = DEFAULT_METHOD,
    templates: tuple[str | Path, ...] = TEMPLATE_NAMES,
    weights: str | Path | None = None,
    up: tuple[float, float, float] | None = None,
    roi: Bounds | None = None,
    read_seconds: float = 0.0,
) -> Inferred:
    """Infers the articulated objects of a cloud.

    `templates` compete for the segments: shipped names or paths of `.toml` files; `weights` names one file for a single
    template (shipped weights otherwise). `up` is the direction away from the support, in the cloud's frame, where it is
    known. `roi` leaves out all points beyond the bounds. All coordinates are in the cloud's frame, metres.

    Raises ValueError where a value does not fit or the cloud cannot be used as it is (units, frame, up), with the mend.
    """
    if method not in METHODS:
        raise ValueError(f"method {method!r} is not known; known are {', '.join(METHODS)}")
    if weights is not None and len(templates) != 1:
        raise ValueError("weights fit one template; name that one alone")
    models = [load_object_model(template, weights)[1] for template in templates]

    start = time.perf_counter()
    points = cloud.points if roi is None else within(cloud.points, roi)
    perception, answer = _core.infer(points, cloud.width, cloud.height, models, viewpoint=cloud.viewpoint, up=up)
    objects = tuple(msgspec.json.decode(text, type=Object) for text in answer.objects_json())
    total = time.perf_counter() - start

    model = Model(
        format="boxwright.model",
        version=1,
        method=method,
        source=Source(file=Path(cloud.path).name if cloud.path else "", points=len(points), organized=cloud.organized),
        warnings=tuple(perception.warnings + answer.warnings),
        seconds=Seconds(read=read_seconds, stages=perception.stage_seconds | answer.stage_seconds, total=total),
        up=_vector(perception.up),
        support_plane=_support_plane(perception),
        free_space="no viewpoint" if cloud.viewpoint is None else "not used",
        objects=objects,
    )
    return Inferred(model, answer.object_labels, answer.part_labels, perception)


def within(points: NDArray[np.float32], roi: Bounds) -> NDArray[np.float32]:
    """A copy of the points (N, 3) in which those beyond the bounds are no readings (NaN).

    Raises ValueError where a low bound is not below its high one.
    """
    low, high = np.array(roi[0::2]), np.array(roi[1::2])
    if not np.all(low < high):
        raise ValueError(
            f"roi {','.join(map(str, roi))}: each low bound comes before its high one: xlo,xhi,ylo,yhi,zlo,zhi"
        )
    inside = np.all((points >= low) & (points <= high), axis=1)
    return np.where(inside[:, None], points, np.float32(np.nan))


def _vector(values: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = (float(v) for v in values)
    return x, y, z


def _support_plane(perception: _core.Perception) -> SupportPlane | None:
    plane = perception.support_plane
    return None if plane is None else SupportPlane(normal=_vector(plane[0]), distance=float(plane[1]))
