"""The compiled core: one flat module, one section for each of its binding files."""

import os
from typing import Literal

import numpy as np
from numpy.typing import NDArray

# --- cloud ---

class CloudArrays:
    """What a reader found: metres, input's frame; `points` (N, 3), `colors` (N, 3), `labels` (N,)."""

    points: NDArray[np.float32]
    width: int
    height: int
    viewpoint: tuple[float, float, float] | None
    colors: NDArray[np.uint8] | None
    labels: NDArray[np.uint32] | None

def read_cloud(
    path: str | os.PathLike[str],
    format: str,
    unit: Literal["m", "mm"],
    frame: Literal["optical", "opengl"],
    viewpoint: tuple[float, float, float] | None,
) -> CloudArrays: ...
def read_depth_png(
    path: str | os.PathLike[str],
    camera: tuple[float, float, float, float],
    size: tuple[int, int] | None,
    distortion: tuple[float, float, float, float, float],
    depth_unit_m: float,
    depth_decode: Literal["none", "rotate3"],
    unit: Literal["m", "mm"],
    frame: Literal["optical", "opengl"],
    viewpoint: tuple[float, float, float] | None,
) -> CloudArrays: ...

# --- perception ---

PLANES: tuple[str, ...]
DEFAULT_PLANES: str
"""The front ends that find planes, as the setting `planes` names them; the default is the core's."""

_EdgeKind = Literal["edge", "crease", "occluded", "border"]

class Perception:
    """Planar segments of a cloud and the support they stand on, as `boxwright.perception.perceive` returns them.

    S segments, N points; metres; every coordinate in the input's frame.
    """

    @property
    def up(self) -> NDArray[np.float64]:
        """(3,) unit vector away from the support."""

    @property
    def support_plane(self) -> tuple[NDArray[np.float64], float] | None:
        """Normal (3,) along `up` and distance (normal . p) in metres; None where the cloud shows no support."""

    @property
    def normals(self) -> NDArray[np.float64]:
        """(S, 3) unit normals, looking at the viewpoint where the cloud has one; else their signs mean nothing."""

    @property
    def distances(self) -> NDArray[np.float64]:
        """(S,) metres: normal . p of each segment's plane."""

    @property
    def rectangles(self) -> NDArray[np.float64]:
        """(S, 4, 3) metres: corners, going round, of the minimum bounding rectangle in each segment's plane."""

    @property
    def hulls(self) -> list[NDArray[np.float64]]:
        """S arrays (H, 3), metres: corners, going round, of each segment's convex hull in its plane."""

    @property
    def edges(self) -> list[tuple[_EdgeKind, _EdgeKind, _EdgeKind, _EdgeKind]]:
        """S times what ends the segment at each side of its rectangle; side k runs from corner k to the next.

        "edge": its own end; "crease": another segment goes on; "occluded": something nearer hides what follows;
        "border": the frame ends (eq. 39, 40).
        """

    @property
    def rms(self) -> NDArray[np.float64]:
        """(S,) metres: root mean square distance of a segment's points from its plane."""

    @property
    def point_counts(self) -> NDArray[np.int64]:
        """(S,) number of points of each segment."""

    @property
    def groups(self) -> NDArray[np.int32]:
        """(S,) number of the cluster that each segment belongs to, from 0, the largest first; -1: support and room."""

    @property
    def labels(self) -> NDArray[np.int32]:
        """(N,) segment of each input point, -1 for none."""

    @property
    def warnings(self) -> list[str]:
        """What a user should know about the answer, one line each."""

    @property
    def stage_seconds(self) -> dict[str, float]:
        """Seconds of each stage, in order."""

    def __len__(self) -> int: ...

def perceive(
    points: NDArray[np.float32],
    width: int,
    height: int,
    viewpoint: tuple[float, float, float] | None = None,
    up: tuple[float, float, float] | None = None,
    **settings: float | str,
) -> Perception: ...

# --- sensor ---

def kinect_camera() -> tuple[float, float, float, float, int, int]:
    """Intrinsics of the default camera: fx, fy, cx, cy (pixels), width, height."""

def simulate_depth(
    triangles: NDArray[np.float64],
    surface_ids: NDArray[np.int32],
    surface_rgb: NDArray[np.uint8],
    seed: int,
    camera: tuple[float, float, float, float, int, int] | None = None,
    noise: float = 1.0,
) -> tuple[NDArray[np.float32], NDArray[np.int32], NDArray[np.uint8]]:
    """A frame of the simulated Kinect: points (H*W, 3) metres with NaN for none, surface ids (H*W,), colours (H*W, 3).

    `triangles` (T, 3, 3) metres, optical frame; id and colour for each triangle; `camera` as of `kinect_camera`, the
    default where None; `noise` times its noise. Id 0: no reading, flying pixels. Same arguments, same bits, on any
    number of threads.

    Raises ValueError for shapes, coordinates or intrinsics that do not fit.
    """

def close_surface_groups(
    triangles: NDArray[np.float64], groups: NDArray[np.int32], gap_m: float
) -> list[tuple[int, int]]:
    """Pairs of groups (smaller first) whose triangles (T, 3, 3) cross or come nearer than `gap_m`; `groups` (T,)."""

# --- model ---

EVIDENCE: tuple[str, ...]
"""What is known of a found part (docs/maths.md, eq. 64)."""

class Template:
    """An object's template, read from TOML text. Raises ValueError naming the key that does not fit."""

    def __init__(self, toml_text: str) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def parts(self) -> list[str]: ...
    @property
    def classes(self) -> list[str]:
        """The class of each part ("side"), aligned with `parts`."""

    @property
    def feature_names(self) -> list[str]: ...
    @property
    def relation_names(self) -> list[str]: ...
    @property
    def edges(self) -> list[tuple[int, int]]:
        """Pairs of part numbers that some relation ties."""

    @property
    def symmetries(self) -> list[list[int]]:
        """Permutations that leave every score unchanged, identity first: `symmetries[k][p]` takes part p's segment."""

class ObjectModel:
    """A template with its weights (JSON text), ready to compete. Raises ValueError where they do not fit."""

    def __init__(self, template: Template, weights_json: str, **search: float | str) -> None: ...

class Answer:
    """What was understood of a cloud of N points."""

    def features_json(self) -> list[str]:
        """What each object and its parts were judged by: {"box": {name: value}, "parts": {part: {name: value}}}."""

    def objects_json(self) -> list[str]:
        """The objects as JSON text, best first, keys as in docs/formats.md."""

    def evidence(self, object: int) -> list[list[float] | None]:
        """What is known of each part of an object, as `EVIDENCE` names it; None where nothing was found or summed."""

    @property
    def object_labels(self) -> NDArray[np.int16]:
        """(N,) object of each point, -1 for none."""

    @property
    def part_labels(self) -> NDArray[np.int16]:
        """(N,) part of each point among its object's parts, -1 for none."""

    @property
    def shapes(self) -> NDArray[np.float64]:
        """(objects, F) what tells each object's kind, as SHAPE_FEATURES; NaN where no body was fitted."""

    @property
    def free_space(self) -> bool:
        """Whether the rays between the camera and the readings were asked for the parts' states."""

    @property
    def warnings(self) -> list[str]: ...
    @property
    def refused(self) -> list[str]:
        """Which candidates are no objects, and why, one line each."""

    @property
    def stage_seconds(self) -> dict[str, float]: ...

SHAPE_FEATURES: list[str]
"""What a fitted box's template is told by, in the order of `Answer.shapes`."""

class Kinds:
    """What each feature of a fitted body's shape counts for each template, from JSON text."""

    def __init__(self, weights_json: str) -> None:
        """Raises ValueError naming the key that does not fit."""

class Judgement:
    """By what fitted boxes, and their panels, are judged, from the text of a judgement file."""

    def __init__(self, judgement_json: str) -> None:
        """Raises ValueError naming the key that does not fit."""

def check_search(**search: float | str) -> None:
    """Refuses settings of the search that do not exist or do not fit, by name: ValueError."""

def check_sizes(sizes: list[tuple[str, tuple[float, float, float]]]) -> None:
    """Refuses outer sizes that no box has, (name, three lengths in metres) each: ValueError."""

def infer(
    points: NDArray[np.float32],
    width: int,
    height: int,
    models: list[ObjectModel],
    viewpoint: tuple[float, float, float] | None = None,
    up: tuple[float, float, float] | None = None,
    perception: dict[str, float | str] | None = None,
    search: dict[str, float | str] | None = None,
    fitted: bool = False,
    kinds: Kinds | None = None,
    judgement: Judgement | None = None,
    sizes: list[tuple[str, tuple[float, float, float]]] = ...,
) -> tuple[Perception, Answer]:
    """From a cloud to its objects in one call, bodies fitted or of rectangles; `kinds` tell fitted boxes' templates.

    Without a `judgement` every fitted box is told. `sizes` are outer sizes that
    fitted boxes may have, as of `check_sizes`. Raises ValueError where the cloud cannot be used, with the mend.
    """

Frame = tuple[NDArray[np.float32], int, int, tuple[float, float, float] | None, list[list[float]]]

def infer_frames(
    frames: list[Frame],
    models: list[ObjectModel],
    kinds: Kinds,
    judgement: Judgement | None = None,
    up: tuple[float, float, float] | None = None,
    perception: dict[str, float | str] | None = None,
    sizes: list[tuple[str, tuple[float, float, float]]] = ...,
) -> tuple[list[Perception], Answer]:
    """From several frames of one scene to its objects in one call, in the first frame's coordinates, as `infer` fitted.

    A frame is points, width, height, viewpoint, and the rows of first_from_frame (4, 4), a rigid motion. Labels are
    numbered on from frame to frame. Raises ValueError where a frame cannot be used, naming it.
    """

def describe(
    perception: Perception,
    points: NDArray[np.float32],
    width: int,
    height: int,
    model: ObjectModel,
    assignments: list[list[int]],
    viewpoint: tuple[float, float, float] | None = None,
    fitted: bool = True,
) -> Answer:
    """The objects of given assignments (K, parts) of the perception's segments, -1 for none; `points` are its cloud's.

    Raises ValueError where the cloud is another or an assignment does not fit the model's template.
    """

def understand(
    perception: Perception, models: list[ObjectModel], search: dict[str, float | str] | None = None
) -> Answer:
    """Objects among the segments that perception saw."""

# --- problem ---

class Problem:
    """The segments of one group under one template: features, scores, search.

    Assignments are int64 (K, parts): the number of the problem's segment that plays each part, -1 for none.
    """

    @staticmethod
    def by_group(perception: Perception, template: Template) -> list[Problem]: ...
    @staticmethod
    def of_segments(perception: Perception, template: Template, segments: list[int]) -> Problem:
        """The problem of these of the perception's segments, of any group."""

    @staticmethod
    def of_values(template: Template, features: NDArray[np.float64], relations: NDArray[np.float64]) -> Problem:
        """The problem of given values: features (F, n) and relations (R, n, n), in the template's order."""

    def without(self, segments: list[int]) -> Problem:
        """The problem without these of its segments; what is left is numbered anew, in the old order. Values stay."""

    def with_features(self, parts: list[list[int]], values: NDArray[np.float64]) -> Problem:
        """The problem with further features, after the template's own: the parts of each, and their values (F, n)."""

    @property
    def scene_segments(self) -> NDArray[np.int64]:
        """(n,) numbers of the problem's segments among the perception's."""

    def __len__(self) -> int: ...
    def features(self, assignments: NDArray[np.int64]) -> NDArray[np.float64]:
        """Feature vectors (K, terms) of assignments (K, parts)."""

    def rank(
        self, weights: NDArray[np.float64], importance: NDArray[np.float64], most: int, **search: float | str
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], float]:
        """The best assignments (K, parts) of the staged search, their scores (K,), and the gap (eq. 1, "Inference")."""

    def solve(
        self, weights: NDArray[np.float64], k: int = 1, budget: int | None = None
    ) -> tuple[NDArray[np.int64], NDArray[np.float64], Literal["optimal", "gap"], float, int]:
        """The k best assignments (K, parts), distinct up to symmetry, and their scores (K,), best first (eq. 44).

        Then the status, the gap, and the nodes visited. "optimal": proven. "gap": `budget` nodes ended the search, and
        no assignment that is not listed scores more than the first plus the gap. Raises ValueError naming a value that
        is no finite number.
        """

    def marginals(
        self,
        weights: NDArray[np.float64],
        temperature: float,
        tolerance: float | None = None,
        budget: int | None = None,
    ) -> tuple[NDArray[np.int64], float, NDArray[np.float64], float]:
        """The best assignment (parts,), its probability, each part's (parts, n + 1), and how far off these may be.

        Column s is the probability that the part is segment s, the last column that it is empty, each assignment turned
        to the symmetric copy that agrees most with the best (eqs. 49-51). The last value is at most `tolerance` unless
        `budget` nodes ended the sums; tolerance 0 leaves nothing out. Raises ValueError as `solve`, and for a
        temperature that is not above 0.
        """

    def score_tables(
        self, weights: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], list[tuple[int, int]], NDArray[np.float64]]:
        """What a score sums up: (parts, n + 1) of parts alone, pairs of parts (E), and theirs (E, n + 1, n + 1).

        State 0 is empty, state s + 1 segment s.
        """

    def exhaustive(self, weights: NDArray[np.float64]) -> tuple[NDArray[np.int64], float, int]:
        """The best of all assignments (parts,), its score, and how many were tried: small problems only."""

# --- arm ---

class Arm:
    """An arm with its gripper, from the TOML text of its file: metres, radians, the base's frame.

    Raises ValueError naming line or key.
    """

    def __init__(self, toml_text: str) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def body_names(self) -> list[str]:
        """The base, the links, the gripper and the fingers."""

    @property
    def limits(self) -> NDArray[np.float64]:
        """(axes, 2) rad: lower and upper."""

    @property
    def ready(self) -> NDArray[np.float64]:
        """(axes,) rad."""

    @property
    def closed_form(self) -> bool:
        """Whether the inverse is a closed form."""

    @property
    def parent_from_joint(self) -> NDArray[np.float64]:
        """(axes, 4, 4): each joint at position 0 on the link before it."""

    @property
    def axes(self) -> NDArray[np.float64]:
        """(axes, 3) unit vectors in each joint's frame."""

    @property
    def last_link_from_flange(self) -> NDArray[np.float64]:
        """(4, 4)."""

    def forward(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """base_from_tool (N, 4, 4) at positions (N, axes)."""

    def link_frames(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """(axes + 2, 4, 4): the base, each link and the flange at positions (axes,)."""

    def jacobian(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """(6, axes): the tool's m/s, then rad/s, for each rad/s of a joint."""

    def inverse(
        self, base_from_tool: NDArray[np.float64], near: NDArray[np.float64] | None = None
    ) -> tuple[NDArray[np.float64], NDArray[np.uint8], NDArray[np.bool_]]:
        """Positions (K, axes) within limits that reach a pose (4, 4), branch (K,), near which singularity (K, 3)."""

# --- collision ---

class World:
    """Solids in the base's frame, metres: boxes, then capsules, then planes below which all is solid."""

    def __init__(
        self,
        boxes: list[tuple[str, NDArray[np.float64], tuple[float, float, float]]] = ...,
        capsules: list[tuple[str, tuple[float, float, float], tuple[float, float, float], float]] = ...,
        planes: list[tuple[str, tuple[float, float, float], float]] = ...,
    ) -> None:
        """(name, base_from_box (4, 4), sizes), (name, from, to, radius), (name, unit normal, distance)."""

    @property
    def names(self) -> list[str]: ...
    def distance_m(self, a: int, b: int) -> float:
        """Signed, between two things by their places in `names`; below 0 the least shift that parts them."""

class Clearance:
    """Whether an arm is far enough from a world and from itself; `ignored` are pairs (body, thing)."""

    def __init__(
        self,
        arm: Arm,
        world: World,
        clearance_m: float,
        opening_m: float,
        ignored: list[tuple[str, str]] = ...,
    ) -> None: ...
    def is_clear(self, positions: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(N,) at positions (N, axes)."""

    def nearest(self, positions: NDArray[np.float64]) -> tuple[str, str, float] | None:
        """The pair with least to spare at positions (axes,): a body, the other's name, their signed distance."""

# --- planning ---

def plan_closing(robot: str, request: str) -> str:
    """The text of a robot's file and a request as JSON (`core::planning::Request`); the motion as JSON."""

def feasible_flaps(robot: str, request: str) -> list[tuple[str, bool]]:
    """For each open flap, by name: can brute force close it by itself, all others as they are? Takes minutes."""

def bearable_flaps(request: str) -> list[tuple[str, bool]]:
    """For each open flap, by name: does the box, as its folds and weight are assumed, stand its closing?"""

def time_way(
    way: NDArray[np.float64], speeds: list[float], accelerations: list[float], period_s: float
) -> tuple[list[float], list[list[float]], list[list[float]]]:
    """The fastest motion along postures (N, axes), rad, from rest to rest: times (M,), positions, velocities (M, axes).

    Raises ValueError where shapes do not fit or nothing moves.
    """
