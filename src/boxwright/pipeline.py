"""From a cloud to its model: the way through that users call."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.models import (
    CLOSED,
    FITTED,
    FITTED_TEMPLATES,
    TEMPLATE_NAMES,
    load_judgement,
    load_kinds,
    load_object_model,
    shipped_for,
)
from boxwright.perception import chosen, require_planes
from boxwright.segmentation import Bounds, source_of, support_plane_of, vector, within
from boxwright.types import Cloud, KnownSize
from boxwright.types.checks import require_direction
from boxwright.types.model import Model, Object, Seconds

METHODS = ("fitted", "exact", "paper")
"""The ways through that are built."""

DEFAULT_METHOD = "fitted"

# Made once, at import: threads that make their first decoder of a type together have crashed.
_OBJECT = msgspec.json.Decoder(Object)

PLANES_OF_METHOD = {"paper": "ransac", "exact": "grid", "fitted": "grid"}
"""The front end of each method where the user names none, one of `_core.PLANES`: the paper's is part of its method."""

TEMPLATES_OF_METHOD = {"paper": TEMPLATE_NAMES, "exact": TEMPLATE_NAMES, "fitted": FITTED_TEMPLATES}
"""The templates that compete where the user names none."""

UNUSED_WEIGHTS = (
    "the weights were not used: with an image and a viewpoint the method fitted judges whole boxes by weights of its "
    "own; name method exact or paper to use yours"
)

FEWEST_PIXELS = 320 * 240 // 2
"""An image of fewer is too coarse for the method fitted: what it asks of panels is counted in pixels."""

SEARCH_OF_METHOD: dict[str, dict[str, float | str]] = {
    "paper": {"search": "staged"},
    "exact": {"search": "exact"},
    "fitted": {"search": "exact"},
}
"""Settings of the search of each method, which a user may override."""


def load_models(
    method: str,
    templates: Sequence[str | Path] | None = None,
    weights: str | Path | None = None,
    planes: str | None = None,
    search: dict[str, float | str] | None = None,
) -> list[_core.ObjectModel]:
    """What `infer` looks for in a cloud, by its arguments of these names; to refuse them before clouds are read.

    Raises ValueError where method, templates, weights, front end or search do not fit, OSError where a file cannot be
    read.
    """
    if method not in METHODS:
        raise ValueError(f"method {method!r} is not known; known are {', '.join(METHODS)}")
    templates = TEMPLATES_OF_METHOD[method] if templates is None else templates
    if method != FITTED and CLOSED in map(str, templates):
        raise ValueError(f"{CLOSED}: closed boxes are told by their rays: name it with the method {FITTED!r}")
    if weights is not None and len(templates) != 1:
        raise ValueError("weights fit one template; name that one alone")
    require_planes(planes)
    front_end = planes if planes and weights is None else PLANES_OF_METHOD[method]
    shipped, settings = shipped_for(method, front_end), SEARCH_OF_METHOD[method] | (search or {})
    return [load_object_model(template, weights, shipped, **settings)[1] for template in templates]


@dataclass(frozen=True)
class Inferred:
    """The answer to one cloud: the model, and for each point (N,) its object and part, int16, -1 for none.

    `shapes` (objects, F) holds what tells each object's template, `_core.SHAPE_FEATURES`; NaN where no body was fitted.
    `refused` says of candidates of the method "fitted" that are no objects why, one line each.
    """

    model: Model
    object_labels: NDArray[np.int16]
    part_labels: NDArray[np.int16]
    perception: _core.Perception
    shapes: NDArray[np.float64]
    refused: tuple[str, ...] = ()


def coarse(cloud: Cloud) -> list[str]:
    """A warning where an organized cloud has too few pixels for the method "fitted", else none."""
    if not cloud.organized or cloud.width * cloud.height >= FEWEST_PIXELS:
        return []
    return [
        f"the image has {cloud.width} x {cloud.height} pixels, which is coarse: a panel is told by some 120 readings "
        "and more, so boxes and flaps may be missed; give 320 x 240 or more"
    ]


def infer(
    cloud: Cloud,
    *,
    method: str = DEFAULT_METHOD,
    templates: tuple[str | Path, ...] | None = None,
    weights: str | Path | None = None,
    up: tuple[float, float, float] | None = None,
    roi: Bounds | None = None,
    planes: str | None = None,
    search: dict[str, float | str] | None = None,
    kinds: _core.Kinds | None = None,
    sizes: Sequence[KnownSize] = (),
    read_seconds: float = 0.0,
) -> Inferred:
    """Infers the articulated objects of a cloud.

    `method` "fitted" proposes open boxes from the planes of the image grid, holds them against the depth image and fits
    each as one body (docs/maths.md, "Whole boxes"); a cloud without image or viewpoint goes by exact assignments there.
    "exact" finds planes on the image grid, proves each object's assignment best and tells how probable it and its parts
    are ("Exact inference"); "paper" is the pipeline of 2011. `templates` compete for the segments: shipped names or
    paths of `.toml` files, by default `TEMPLATES_OF_METHOD`; `weights` names one file for a single template (the
    method's shipped weights otherwise). `up` is the direction away from the support, in the cloud's frame, where it is
    known. `roi` leaves out all points beyond the bounds. `planes` names the front end that finds the planes, one of
    `_core.PLANES`; None takes the method's own (`PLANES_OF_METHOD`). All coordinates are in the cloud's frame, metres.
    `search` overrides settings of the search by name: `{"search": "exact"}` proves each object's assignment best and
    tells its probability (docs/maths.md, "Exact inference"); "staged" is the paper's. `kinds` replaces the shipped
    weights by which the method "fitted" tells a box's template (eq. 89).

    `sizes` are outer sizes that boxes may have ("fitted" alone): a box that has one is taken to have it exactly, and of
    rival boxes those that have one win; `warnings` tell of boxes that have none, and when no box in view has any.

    Raises ValueError where a value does not fit or the cloud cannot be used as it is (units, frame, up), with the mend.
    """
    models = load_models(method, templates, weights, planes, search)
    if sizes and method != "fitted":
        raise ValueError(f"method {method!r} knows no sizes; give them to method 'fitted'")
    if up is not None:
        require_direction("up", up)
    planes = planes or PLANES_OF_METHOD[method]

    start = time.perf_counter()
    points = cloud.points if roi is None else within(cloud.points, roi)
    perception, answer = _core.infer(
        points,
        cloud.width,
        cloud.height,
        models,
        viewpoint=cloud.viewpoint,
        up=up,
        perception=chosen(planes),
        search=SEARCH_OF_METHOD[method] | (search or {}),
        fitted=method == "fitted",
        kinds=(kinds or load_kinds()) if method == "fitted" else None,
        sizes=[(size.name, size.outer) for size in sizes],
        judgement=load_judgement() if method == "fitted" else None,
    )
    objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
    unused = [UNUSED_WEIGHTS] if weights is not None and method == "fitted" and answer.free_space else []
    total = time.perf_counter() - start

    model = Model(
        format="boxwright.model",
        version=1,
        method=method,
        source=source_of(cloud),
        warnings=tuple(perception.warnings + answer.warnings + unused + (coarse(cloud) if method == "fitted" else [])),
        seconds=Seconds(read=read_seconds, stages=perception.stage_seconds | answer.stage_seconds, total=total),
        up=vector(perception.up),
        support_plane=support_plane_of(perception),
        free_space="no viewpoint" if cloud.viewpoint is None else "used" if answer.free_space else "not used",
        objects=objects,
    )
    refused = tuple(answer.refused)
    return Inferred(model, answer.object_labels, answer.part_labels, perception, answer.shapes, refused)
