"""What `plan` says (`plan.json`, docs/formats.md): which flaps are closed in which order, and the motions that do it.

Metres, radians, seconds; contacts are in the robot's base frame. Keys that are not known are ignored when read. Values
are checked when made; each check raises ValueError with one line.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Literal

import msgspec

from boxwright.types.checks import require_finite, require_name, require_not_negative
from boxwright.types.truth import Vector

Row = tuple[float, float, float, float]
Matrix4 = tuple[Row, Row, Row, Row]
"""A rigid transform, row by row."""

RIGID_TOLERANCE = 1e-6
"""How far a transform's rotation may be from orthonormal."""

FlapStatus = Literal[
    "planned", "already_closed", "hidden", "absent", "unreachable", "joint_limit", "blocked", "out_of_time"
]
SegmentKind = Literal["transit", "approach", "push", "retreat"]


class SmallestMove(msgspec.Struct, frozen=True, kw_only=True):
    """The smallest move found of the robot's base that would let a flap be closed.

    Metres and radians in the base's frame: (`x_m`, `y_m`, `z_m`), then a turn by `yaw_rad` about its z. Moving box and
    support the other way comes to the same.
    """

    x_m: float
    y_m: float
    z_m: float
    yaw_rad: float

    def __post_init__(self) -> None:
        require_finite("move", [self.x_m, self.y_m, self.z_m, self.yaw_rad])


class FlapOutcome(msgspec.Struct, frozen=True, kw_only=True):
    """What became of a flap: `reason` says why in one line, None where it is planned; `seconds` were spent on it.

    `move` would make it possible; None where the flap needs none, or where none was looked for or found. `rest_rad` is
    the hinge position at which a planned flap is taken to rest after it was let go; None where it is not planned.
    """

    status: FlapStatus
    reason: str | None
    seconds: float
    move: SmallestMove | None = None
    rest_rad: float | None = None

    def __post_init__(self) -> None:
        require_not_negative("seconds", [self.seconds])
        require_finite("rest_rad", [self.rest_rad or 0.0])
        if (self.status == "planned") != (self.reason is None):
            raise ValueError(
                f"reason is {self.reason!r} where status is {self.status!r}; planned flaps alone have none"
            )


class PlanSegment(msgspec.Struct, frozen=True, kw_only=True):
    """A piece of the trajectory with N samples: between flaps, to one, pushing it, or away from it.

    `times` (N) are seconds since the plan's start and begin where the segment before ended; `positions` and
    `velocities` (N, J) follow `joint_names`. In a push `hinge_angle_rad` (N) is where the flap's hinge is meant to be
    and `contact` (N, 3) the point of the tool that touches the flap, base frame; elsewhere they are None.
    """

    flap: str | None
    kind: SegmentKind
    times: tuple[float, ...]
    positions: tuple[tuple[float, ...], ...]
    velocities: tuple[tuple[float, ...], ...]
    gripper_opening_m: float
    hinge_angle_rad: tuple[float, ...] | None = None
    contact: tuple[Vector, ...] | None = None

    def __post_init__(self) -> None:
        require_not_negative("gripper_opening_m", [self.gripper_opening_m])
        if (self.flap is None) != (self.kind == "transit"):
            raise ValueError(f"flap is {self.flap!r} in a segment of kind {self.kind!r}; it is null in transit alone")
        _require_growing(self.times)
        count = len(self.times)
        for name in ("positions", "velocities"):
            _require_rows(name, getattr(self, name), count)
        for name in ("hinge_angle_rad", "contact"):
            if (getattr(self, name) is not None) != (self.kind == "push"):
                raise ValueError(f"{name} belongs to a push and to no other kind; this is of kind {self.kind!r}")
        if self.hinge_angle_rad is not None and self.contact is not None:
            _require_rows("hinge_angle_rad", tuple((value,) for value in self.hinge_angle_rad), count)
            _require_rows("contact", self.contact, count)


class Plan(msgspec.Struct, frozen=True, kw_only=True):
    """Motions that close the flaps of one object of a model, and why some stay open.

    `order` names the flaps that are closed, first to last; `flaps` tells of every flap of the template. Joined, the
    `segments` are one motion without a jump. `method` is the planner's name, `object` the object's place in the model.
    """

    format: Literal["boxwright.plan"]
    version: Literal[1]
    robot: str
    base_from_input: Matrix4
    joint_names: tuple[str, ...]
    order: tuple[str, ...]
    flaps: dict[str, FlapOutcome]
    segments: tuple[PlanSegment, ...]
    method: str = "layered"
    object: int = 0
    warnings: tuple[str, ...] = ()
    seconds: float = 0.0
    """Time that planning took: from the model in memory to the plan in memory."""

    def __post_init__(self) -> None:
        require_name("robot", self.robot)
        require_rigid("base_from_input", self.base_from_input)
        require_not_negative("seconds", [self.seconds])
        for name in self.joint_names:
            require_name("joint_names", name)
        for name in self.order:
            if name not in self.flaps or self.flaps[name].status != "planned":
                raise ValueError(f"order holds {name!r}, which is no planned flap")
        _require_one_motion(self.segments, len(self.joint_names))


def require_rigid(name: str, matrix: Matrix4) -> None:
    """Refuse what is no rotation with a translation, right-handed, last row 0 0 0 1."""
    for row in matrix:
        require_finite(name, row)
    if matrix[3] != (0.0, 0.0, 0.0, 1.0):
        raise ValueError(f"{name} has the last row {list(matrix[3])}; it must be 0, 0, 0, 1")
    axes = [tuple(matrix[i][j] for i in range(3)) for j in range(3)]
    x, y, z = axes
    products = [sum(a * b for a, b in zip(first, second, strict=True)) for first, second in ((x, y), (y, z), (z, x))]
    handed = (
        (x[1] * y[2] - x[2] * y[1]) * z[0] + (x[2] * y[0] - x[0] * y[2]) * z[1] + (x[0] * y[1] - x[1] * y[0]) * z[2]
    )
    lengths = [math.hypot(*axis) - 1.0 for axis in axes]
    if max(abs(value) for value in (*products, *lengths, handed - 1.0)) > RIGID_TOLERANCE:
        raise ValueError(f"{name} holds no rotation; its first three columns must be orthonormal and right-handed")


def _require_growing(times: tuple[float, ...]) -> None:
    if len(times) < 2:
        raise ValueError(f"times holds {len(times)} samples; a segment has at least 2")
    require_finite("times", times)
    if any(after <= before for before, after in pairwise(times)):
        raise ValueError("times do not grow; each must be later than the one before")


def _require_rows(name: str, rows: tuple[tuple[float, ...], ...], count: int) -> None:
    if len(rows) != count:
        raise ValueError(f"{name} has {len(rows)} rows and times {count}; they must be as many")
    for row in rows:
        require_finite(name, row)


def _require_one_motion(segments: tuple[PlanSegment, ...], joints: int) -> None:
    """Every sample has a value for each joint, and each segment begins where and when the one before ended."""
    before: PlanSegment | None = None
    for number, segment in enumerate(segments):
        for row in (*segment.positions, *segment.velocities):
            if len(row) != joints:
                raise ValueError(f"segment {number} has a row of {len(row)} values; joint_names has {joints}")
        if before is not None:
            if segment.times[0] != before.times[-1]:
                raise ValueError(
                    f"segment {number} begins at {segment.times[0]} s; the one before ends at another time"
                )
            if segment.positions[0] != before.positions[-1]:
                raise ValueError(f"segment {number} begins at other positions than the one before ends at")
        before = segment
