"""The model of a box as if it had been inferred without an error, from its truth."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from boxwright.simulation.physics import true_box
from boxwright.types import (
    Inference,
    Joint,
    Model,
    Object,
    Part,
    Pose,
    Seconds,
    Source,
    SupportPlane,
    Truth,
)


def model_of(truth: Truth, template: str = "carton") -> Model:
    """One object for each true box, in the truth's frame."""
    up = truth.up
    boxes = [true_box(truth, k, np.eye(4)) for k in range(len(truth.boxes))]
    lowest = boxes[0].world_from_box[:3, 3] @ np.array(up)
    return Model(
        format="boxwright.model",
        version=1,
        method="truth",
        source=Source(file="truth", points=0, organized=False),
        warnings=(),
        seconds=Seconds(read=0.0, stages={}, total=0.0),
        up=up,
        support_plane=SupportPlane(normal=up, distance=float(lowest)),
        free_space="not used",
        objects=tuple(_object(truth, k, template) for k in range(len(boxes))),
    )


def _object(truth: Truth, index: int, template: str) -> Object:
    box = true_box(truth, index, np.eye(4))
    dims = truth.boxes[index].dims
    parts, joints = [], []
    for board in box.boards:
        corners = tuple(map(tuple, board.corners.tolist()))
        parts.append(Part(name=board.name, observed=True, state=None, corners=corners, points=1000))  # type: ignore[arg-type]
        if board.hinge is not None:
            low, high = (-np.pi / 2, np.pi) if board.name.startswith("tuck") else (-np.pi / 2, 1.5 * np.pi)
            joints.append(
                Joint(
                    name=f"{board.name}_hinge",
                    type="revolute",
                    parent=board.hinge.parent,
                    child=board.name,
                    origin=tuple(board.hinge.origin.tolist()),
                    axis=tuple(board.hinge.axis.tolist()),
                    position=board.hinge.position_rad,
                    limits=(low, high),
                    sigma=None,
                )
            )
    pose = box.world_from_box
    return Object(
        template=template,
        template_probability=1.0,
        score=0.0,
        probability=1.0,
        inference=Inference(status="optimal", gap=0.0, alternatives=0),
        dimensions=dims,
        outer_dimensions=dims,
        thickness=box.thickness_m,
        pose=Pose(
            position=tuple(pose[:3, 3].tolist()),
            orientation=tuple(Rotation.from_matrix(pose[:3, :3]).as_quat().tolist()),
        ),
        parameters={},
        parts=tuple(parts),
        joints=tuple(joints),
    )
