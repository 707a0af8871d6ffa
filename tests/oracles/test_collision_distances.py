"""Signed distances of every pair of kinds against coal's GJK and EPA, over random solids apart and overlapping."""

from __future__ import annotations

from collections.abc import Callable

import coal
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from boxwright import _core

Array = NDArray[np.float64]
Draw = Callable[[np.random.Generator], "Solid"]

PAIRS = 2_000
TOLERANCE_M = 1e-6
"""What coal is asked for; ours is exact to rounding."""


class Solid:
    """A solid both ways: as coal has it, and as arguments of `World`."""

    def __init__(self, kind: str, ours: tuple[object, ...], shape: coal.CollisionGeometry, place: Array) -> None:
        self.kind, self.ours, self.shape = kind, ours, shape
        self.place = coal.Transform3s(place[:3, :3], place[:3, 3])


def box(rng: np.random.Generator) -> Solid:
    size = rng.uniform([0.02, 0.02, 0.002], [0.4, 0.4, 0.1])
    place = np.eye(4)
    place[:3, :3] = Rotation.random(rng=rng).as_matrix()
    place[:3, 3] = rng.uniform(-0.2, 0.2, 3)
    return Solid("boxes", (place, tuple(size)), coal.Box(*size), place)


def capsule(rng: np.random.Generator) -> Solid:
    start, end, radius = rng.uniform(-0.3, 0.3, 3), rng.uniform(-0.3, 0.3, 3), rng.uniform(0.005, 0.08)
    length = float(np.linalg.norm(end - start))
    place = np.eye(4)
    place[:3, :3] = Rotation.align_vectors([(end - start) / length], [[0.0, 0.0, 1.0]])[0].as_matrix()
    place[:3, 3] = (start + end) / 2.0
    return Solid("capsules", (tuple(start), tuple(end), radius), coal.Capsule(radius, length), place)


def half_space(rng: np.random.Generator) -> Solid:
    normal = Rotation.random(rng=rng).as_matrix()[2]
    distance = rng.uniform(-0.4, 0.1)
    return Solid("planes", (tuple(normal), distance), coal.Halfspace(normal, distance), np.eye(4))


def ours(a: Solid, b: Solid) -> float:
    kinds: dict[str, list[tuple[object, ...]]] = {"boxes": [], "capsules": [], "planes": []}
    for name, solid in (("a", a), ("b", b)):
        kinds[solid.kind].append((name, *solid.ours))
    return _core.World(**kinds).distance_m(0, 1)  # type: ignore[arg-type]


def theirs(a: Solid, b: Solid) -> float:
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    request.gjk_tolerance = request.epa_tolerance = TOLERANCE_M / 100.0
    request.gjk_max_iterations = request.epa_max_iterations = 1000
    return float(coal.distance(a.shape, a.place, b.shape, b.place, request, result))


@pytest.mark.parametrize("other", [box, capsule, half_space])
@pytest.mark.parametrize("one", [box, capsule])
def test_distances_are_coals(one: Draw, other: Draw) -> None:
    rng = np.random.default_rng(6)
    apart = overlapping = 0
    for _ in range(PAIRS):
        a, b = one(rng), other(rng)
        distance_m = ours(a, b)
        assert distance_m == pytest.approx(theirs(a, b), abs=TOLERANCE_M)
        apart += distance_m > 0.0
        overlapping += distance_m <= 0.0
    assert apart + overlapping == PAIRS
    assert min(apart, overlapping) > PAIRS // 6
