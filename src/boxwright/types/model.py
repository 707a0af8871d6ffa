"""What `infer` says of a cloud (`model.json`, docs/formats.md): the scene and its articulated objects.

Metres, radians, seconds; every coordinate is in the input's frame. Keys that are not known are ignored when read.
Values are checked when made: a record that exists is usable. Each check raises ValueError with one line.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from boxwright.types.articulation import Joint, Parameter, Part, Pose
from boxwright.types.checks import (
    require_finite,
    require_name,
    require_not_negative,
    require_positive,
    require_probability,
    require_unit,
)
from boxwright.types.known_size import MatchedSize
from boxwright.types.truth import Vector


class FrameSource(msgspec.Struct, frozen=True, kw_only=True):
    """One of several frames of a scene: its file's name, its points, and where its coordinates lie in the model's."""

    file: str
    points: int
    input_from_frame: Pose

    def __post_init__(self) -> None:
        require_not_negative("points", [self.points])


class Source(msgspec.Struct, frozen=True, kw_only=True):
    """Where the model comes from: the file's name, its number of points (invalid ones counted), organized or not.

    Of several frames `file` is the file of poses, `points` those of all, and `frames` lists them; the model's
    coordinates are those of the first.
    """

    file: str
    points: int
    organized: bool
    frames: tuple[FrameSource, ...] = ()

    def __post_init__(self) -> None:
        require_not_negative("points", [self.points])


class Seconds(msgspec.Struct, frozen=True, kw_only=True):
    """`total` is from the cloud in memory to the model in memory, `stages` its parts by name; `read` stands apart."""

    read: float
    stages: dict[str, float]
    total: float

    def __post_init__(self) -> None:
        require_not_negative("read", [self.read])
        require_not_negative("stages", self.stages.values())
        require_not_negative("total", [self.total])


class SupportPlane(msgspec.Struct, frozen=True, kw_only=True):
    """The plane that the objects stand on: points p (metres) with normal . p = distance; the normal is up."""

    normal: Vector
    distance: float

    def __post_init__(self) -> None:
        require_unit("normal", self.normal)
        require_finite("distance", [self.distance])


class Inference(msgspec.Struct, frozen=True, kw_only=True):
    """How sure the search is that no assignment scores higher.

    `status` "optimal": proven, and `gap` is 0. "gap": not proven; `gap` bounds what a better one could add to the
    score, None where the method knows no bound. `alternatives` counts the other assignments ranked against this one.
    `unsummed` is the share of the probability that sums over assignments left out at most, None where none were made.
    """

    status: Literal["optimal", "gap"]
    gap: float | None
    alternatives: int
    unsummed: float | None = None

    def __post_init__(self) -> None:
        require_probability("unsummed", self.unsummed)
        if self.gap is not None:
            require_not_negative("gap", [self.gap])
        if self.status == "optimal" and self.gap != 0.0:
            raise ValueError(f"gap is {self.gap} where status is 'optimal'; it must be 0 there")
        require_not_negative("alternatives", [self.alternatives])


class ScoreTerm(msgspec.Struct, frozen=True, kw_only=True):
    """One feature or relation of the template, summed over its parts, in radians, metres or a count as its kind says.

    `kind` is the paper's name ("phi 1", "Gamma 3"), or "evidence" of what a whole box was judged by: a feature, or all
    trees together (docs/maths.md, eq. 90); `contribution` = weight x value is its share of the score.
    """

    name: str
    kind: str
    value: float
    weight: float
    contribution: float

    def __post_init__(self) -> None:
        require_name("name", self.name)
        require_finite("score_terms", [self.value, self.weight, self.contribution])


class Object(msgspec.Struct, frozen=True, kw_only=True):
    """One articulated object.

    `score` is the log odds of a whole box (method fitted: docs/maths.md, eq. 90), or J(G) of an assignment (eq. 1), and
    `probability` that of the same; `score_terms` sum to the score, and are empty where they are not known. `dimensions`
    and `outer_dimensions` are length, width, height and `thickness` the board's, metres; `pose` is input_from_object.
    They are None where too little was seen to say (paper's method: fewer than two sides), as are probabilities that the
    method does not have. `parts` lists every part of the template; `joints` what turns; `size` is the given size that
    it has, None without one.
    """

    template: str
    template_probability: float | None
    score: float
    probability: float | None
    inference: Inference
    dimensions: Vector | None
    outer_dimensions: Vector | None
    thickness: float | None
    pose: Pose | None
    parameters: dict[str, Parameter]
    parts: tuple[Part, ...]
    joints: tuple[Joint, ...]
    score_terms: tuple[ScoreTerm, ...] = ()
    size: MatchedSize | None = None

    def __post_init__(self) -> None:
        require_name("template", self.template)
        require_probability("template_probability", self.template_probability)
        require_finite("score", [self.score])
        require_probability("probability", self.probability)
        require_positive("dimensions", self.dimensions or ())
        require_positive("outer_dimensions", self.outer_dimensions or ())
        if self.thickness is not None:
            require_not_negative("thickness", [self.thickness])
        _require_distinct("parts", [part.name for part in self.parts])
        _require_distinct("joints", [joint.name for joint in self.joints])
        _require_forest(self.parts, self.joints)

    def part(self, name: str) -> Part:
        """The part of that name; KeyError where the template has none."""
        for part in self.parts:
            if part.name == name:
                return part
        raise KeyError(name)


class Model(msgspec.Struct, frozen=True, kw_only=True):
    """All that `infer` says of one input. `up` is a unit vector away from the support; `objects` come best first."""

    format: Literal["boxwright.model"]
    version: Literal[1]
    method: str
    source: Source
    warnings: tuple[str, ...]
    seconds: Seconds
    up: Vector
    support_plane: SupportPlane | None
    free_space: Literal["used", "no viewpoint", "not used"]
    objects: tuple[Object, ...]

    def __post_init__(self) -> None:
        require_unit("up", self.up)


def _require_distinct(key: str, names: list[str]) -> None:
    for name in names:
        if names.count(name) > 1:
            raise ValueError(f"{key} holds {name!r} more than once; names must differ")


def _require_forest(parts: tuple[Part, ...], joints: tuple[Joint, ...]) -> None:
    """Joints tie parts that have corners; each child hangs on one parent, and none on itself over any detour."""
    placed = {part.name for part in parts if part.corners is not None}
    parent_of: dict[str, str] = {}
    for joint in joints:
        for role, name in (("parent", joint.parent), ("child", joint.child)):
            if name not in placed:
                raise ValueError(f"joint {joint.name!r} has {role} {name!r}, which is no part with corners")
        if joint.child in parent_of:
            raise ValueError(f"joint {joint.name!r} has child {joint.child!r}, which already hangs on another joint")
        parent_of[joint.child] = joint.parent
    for start in parent_of:
        passed = {start}
        name = parent_of[start]
        while name in parent_of and name not in passed:
            passed.add(name)
            name = parent_of[name]
        if name in passed:
            raise ValueError(f"joints go round in a circle through {name!r}; they must form trees")
