"""Parts and joints of an articulated object, as `model.json` lists them: metres, radians, the input's frame."""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.checks import (
    require_finite,
    require_name,
    require_not_negative,
    require_probability,
    require_unit,
)
from boxwright.types.truth import Vector

Quaternion = tuple[float, float, float, float]
"""Unit quaternion x, y, z, w."""

Corners = tuple[Vector, Vector, Vector, Vector]
"""Corners of a panel at mid-board, metres, in the order of docs/formats.md."""

STATE_SUM_TOLERANCE = 1e-6
"""How far the probabilities of a part's states may be from summing to 1."""


class Pose(msgspec.Struct, frozen=True, kw_only=True):
    """A frame's origin (metres) and its rotation (unit quaternion x, y, z, w), seen from another frame."""

    position: Vector
    orientation: Quaternion

    def __post_init__(self) -> None:
        require_finite("position", self.position)
        require_unit("orientation", self.orientation)


class Parameter(msgspec.Struct, frozen=True, kw_only=True):
    """A fitted number of the body and its standard deviation, in the SI unit of its name; sigma None where unknown."""

    value: float
    sigma: float | None

    def __post_init__(self) -> None:
        require_finite("value", [self.value])
        if self.sigma is not None:
            require_not_negative("sigma", [self.sigma])


class PartState(msgspec.Struct, frozen=True, kw_only=True):
    """Probabilities that a part was seen, is there but hidden, or is not there; they sum to 1."""

    seen: float
    hidden: float
    absent: float

    def __post_init__(self) -> None:
        for name, value in (("seen", self.seen), ("hidden", self.hidden), ("absent", self.absent)):
            require_probability(name, value)
        total = self.seen + self.hidden + self.absent
        if abs(total - 1.0) > STATE_SUM_TOLERANCE:
            raise ValueError(f"seen, hidden and absent sum to {total:.9g}; they must sum to 1")


class Part(msgspec.Struct, frozen=True, kw_only=True):
    """One panel; `points` counts its readings.

    `corners` (4, 3) of a base or side that was not observed are where the body implies it; those of a flap are None.
    """

    name: str
    observed: bool
    state: PartState | None
    corners: Corners | None
    points: int
    probability: float | None = None
    """That its points are this panel's; None where the method has none, or where it was not observed."""
    seen_from: Vector | None = None
    """Of a hidden part: unit vector from it towards the nearest place that would see it; None where none is known."""

    def __post_init__(self) -> None:
        require_name("name", self.name)
        require_probability("probability", self.probability)
        for corner in self.corners or ():
            require_finite("corners", corner)
        require_not_negative("points", [self.points])
        if self.seen_from is not None:
            require_unit("seen_from", self.seen_from)
        if self.observed and self.corners is None:
            raise ValueError(f"part {self.name!r} is observed but has no corners; an observed part has them")


class JointSigma(msgspec.Struct, frozen=True, kw_only=True):
    """Standard deviations: position rad, origin (3) m, axis rad."""

    position: float
    origin: Vector
    axis: float

    def __post_init__(self) -> None:
        require_not_negative("position", [self.position])
        require_not_negative("origin", self.origin)
        require_not_negative("axis", [self.axis])


class Joint(msgspec.Struct, frozen=True, kw_only=True):
    """A hinge as it was measured.

    `origin` is the middle of the hinge edge (m), `axis` a unit vector; turning the child about the axis by the right
    hand grows `position` (rad). `limits` are lo, hi; a measured position may lie outside them by its error.
    """

    name: str
    type: Literal["revolute"]
    parent: str
    child: str
    origin: Vector
    axis: Vector
    position: float
    limits: tuple[float, float]
    sigma: JointSigma | None

    def __post_init__(self) -> None:
        require_name("name", self.name)
        require_finite("origin", self.origin)
        require_unit("axis", self.axis)
        require_finite("position", [self.position])
        require_finite("limits", self.limits)
        if self.limits[0] >= self.limits[1]:
            raise ValueError(
                f"limits of joint {self.name!r} are {list(self.limits)}; the lower must be below the upper"
            )
