"""From several frames of one static scene to one model: a camera on an arm looks more than once."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.io.labels import PointLabels
from boxwright.kinematics.transforms import Matrix, apply, inverse, quaternion_wxyz
from boxwright.models import load_judgement, load_kinds
from boxwright.perception import chosen
from boxwright.pipeline import PLANES_OF_METHOD, Inferred, coarse, load_models
from boxwright.segmentation import Bounds, inside, support_plane_of, vector
from boxwright.types import Cloud, FrameSource, KnownSize, Pose, PosedCloud, Source
from boxwright.types.checks import require_direction
from boxwright.types.model import Model, Object, Seconds

METHOD = "fitted"
"""Frames are fused by the method that fits bodies to readings."""

# Made once, at import: threads that make their first decoder of a type together have crashed.
_OBJECT = msgspec.json.Decoder(Object)


@dataclass(frozen=True)
class Fused:
    """The answer to several frames: the model in the first one's coordinates, and for each frame its points' labels.

    `shapes` are those of `Inferred`.
    """

    model: Model
    labels: tuple[PointLabels, ...]
    perceptions: tuple[_core.Perception, ...]
    shapes: NDArray[np.float64]
    refused: tuple[str, ...]
    """Candidates that are no objects, and why, one line each."""

    @property
    def first(self) -> Inferred:
        """The answer with the labels of the first frame alone."""
        labels = self.labels[0]
        return Inferred(self.model, labels.object, labels.part, self.perceptions[0], self.shapes, self.refused)


def infer_frames(
    frames: Sequence[PosedCloud],
    *,
    templates: tuple[str | Path, ...] | None = None,
    up: tuple[float, float, float] | None = None,
    roi: Bounds | None = None,
    planes: str | None = None,
    kinds: _core.Kinds | None = None,
    sizes: Sequence[KnownSize] = (),
    read_seconds: float = 0.0,
    source: str = "",
) -> Fused:
    """Infers the open boxes of a scene that several frames show, taken from known places while nothing moved.

    Each frame finds its boxes by the method "fitted"; one body is fitted to the readings of all frames for each, and
    every ray of every frame says whether its panels are there (docs/maths.md, "Several views"). The model's coordinates
    are those of the first frame, and so are `up` and `roi`; `seen_from` starts from the last one's camera. One frame
    gives what `infer` gives. The other arguments are those of `infer`; `source` names the file that told the poses.

    Raises ValueError where there is no frame, where one has no image grid or viewpoint, and as `infer` does, naming the
    frame, counted from 1.
    """
    models = load_models(METHOD, templates, planes=planes)
    planes = planes or PLANES_OF_METHOD[METHOD]
    if up is not None:
        require_direction("up", up)
    if not frames:
        raise ValueError("there is no frame; give at least one")

    start = time.perf_counter()
    first_from_frame = [inverse(frames[0].base_from_camera) @ frame.base_from_camera for frame in frames]
    clouds = [
        (_within(k, frame.cloud, pose, roi), *_grid(frame.cloud), frame.cloud.viewpoint, pose.tolist())
        for k, (frame, pose) in enumerate(zip(frames, first_from_frame, strict=True), start=1)
    ]
    perceptions, answer = _core.infer_frames(
        clouds,
        models,
        kinds or load_kinds(),
        judgement=load_judgement(),
        up=up,
        perception=chosen(planes),
        sizes=[(size.name, size.outer) for size in sizes],
    )
    objects = tuple(_OBJECT.decode(text) for text in answer.objects_json())
    total = time.perf_counter() - start

    first = perceptions[0]
    model = Model(
        format="boxwright.model",
        version=1,
        method=METHOD,
        source=_source(source, frames, first_from_frame),
        warnings=_warnings(frames, perceptions, answer),
        seconds=Seconds(read=read_seconds, stages=_stages(perceptions, answer), total=total),
        up=vector(first.up),
        support_plane=support_plane_of(first),
        free_space="used",
        objects=objects,
    )
    labels = _by_frame(answer, frames)
    return Fused(model, labels, tuple(perceptions), answer.shapes, tuple(answer.refused))


def _grid(cloud: Cloud) -> tuple[int, int]:
    return cloud.width, cloud.height


def _within(number: int, cloud: Cloud, first_from_frame: Matrix, roi: Bounds | None) -> NDArray[np.float32]:
    """A frame's points, those beyond the bounds in the first frame's coordinates being no readings."""
    if roi is None:
        return cloud.points
    try:
        kept = inside(apply(first_from_frame, cloud.points.astype(np.float64)), roi)
    except ValueError as error:
        raise ValueError(f"frame {number}: {error}") from None
    return np.where(kept[:, None], cloud.points, np.float32(np.nan))


def _source(file: str, frames: Sequence[PosedCloud], first_from_frame: list[Matrix]) -> Source:
    each = tuple(
        FrameSource(
            file=Path(frame.cloud.path).name if frame.cloud.path else "",
            points=len(frame.cloud.points),
            input_from_frame=_pose(pose),
        )
        for frame, pose in zip(frames, first_from_frame, strict=True)
    )
    return Source(file=file, points=sum(frame.points for frame in each), organized=True, frames=each)


def _pose(a_from_b: Matrix) -> Pose:
    w, x, y, z = quaternion_wxyz(a_from_b)
    return Pose(position=vector(a_from_b[:3, 3]), orientation=(x, y, z, w))


def _warnings(
    frames: Sequence[PosedCloud], perceptions: list[_core.Perception], answer: _core.Answer
) -> tuple[str, ...]:
    of_frames = [
        f"frame {k}: {line}"
        for k, (frame, seen) in enumerate(zip(frames, perceptions, strict=True), start=1)
        for line in seen.warnings + coarse(frame.cloud)
    ]
    return tuple(of_frames + answer.warnings)


def _stages(perceptions: list[_core.Perception], answer: _core.Answer) -> dict[str, float]:
    """Seconds by stage, those of perception summed over the frames."""
    seconds: dict[str, float] = {}
    for seen in perceptions:
        for stage, spent in seen.stage_seconds.items():
            seconds[stage] = seconds.get(stage, 0.0) + spent
    return seconds | answer.stage_seconds


def _by_frame(answer: _core.Answer, frames: Sequence[PosedCloud]) -> tuple[PointLabels, ...]:
    ends = np.cumsum([len(frame.cloud.points) for frame in frames])[:-1]
    pairs = zip(np.split(answer.object_labels, ends), np.split(answer.part_labels, ends), strict=True)
    return tuple(PointLabels(object=objects, part=parts) for objects, parts in pairs)
