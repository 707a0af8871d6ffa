"""Household things, each standing on z = 0 about the z axis; triangles (T, 3, 3) in metres."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.meshes import cuboid, revolve, sphere
from boxwright.simulation.poses import apply, rotation, standing, translation

Array = NDArray[np.float64]
Rng = np.random.Generator


def cup(rng: Rng) -> Array:
    radius, height, wall = rng.uniform(0.03, 0.045), rng.uniform(0.07, 0.12), 0.003
    foot = radius * rng.uniform(0.7, 1.0)
    return revolve([(0, 0), (foot, 0), (radius, height), (radius - wall, height), (foot - wall, wall), (0, wall)])


def mug(rng: Rng) -> Array:
    body = cup(rng)
    reach, height = body[..., 0].max(), body[..., 2].max()
    bar = cuboid((0.030, 0.010, 0.010))
    grip = cuboid((0.010, 0.010, 0.45 * height))
    parts = [translation([reach + 0.010, 0, z * height]) for z in (0.25, 0.62)]
    return np.concatenate(
        [body, *(apply(p, bar) for p in parts), apply(translation([reach + 0.022, 0, 0.25 * height]), grip)]
    )


def bottle(rng: Rng) -> Array:
    radius, height = rng.uniform(0.03, 0.045), rng.uniform(0.18, 0.30)
    neck = radius * rng.uniform(0.3, 0.5)
    profile = [(0, 0), (radius, 0), (radius, 0.62 * height), (0.8 * radius, 0.7 * height), (neck, 0.8 * height)]
    standing_bottle = revolve([*profile, (neck, height), (0, height)])
    if rng.random() < 0.35:
        return apply(translation([-height / 2, 0, radius]) @ rotation([0, 1, 0], np.pi / 2), standing_bottle)
    return standing_bottle


def can(rng: Rng) -> Array:
    radius, height = rng.uniform(0.026, 0.05), rng.uniform(0.06, 0.14)
    return revolve(
        [
            (0, 0),
            (radius, 0),
            (radius, height),
            (0.92 * radius, height),
            (0.9 * radius, height - 0.004),
            (0, height - 0.004),
        ]
    )


def ball(rng: Rng) -> Array:
    return sphere(rng.uniform(0.02, 0.11) if rng.random() < 0.7 else rng.uniform(0.02, 0.05))


def book(rng: Rng) -> Array:
    return cuboid((rng.uniform(0.11, 0.22), rng.uniform(0.15, 0.30), rng.uniform(0.01, 0.05)))


def books(rng: Rng) -> Array:
    """A stack, turned against one another."""
    height, stack = 0.0, []
    for _ in range(int(rng.integers(2, 4))):
        one = book(rng)
        stack.append(apply(standing(0, 0, rng.normal(0, 0.2), height), one))
        height += one[..., 2].max() + 0.0003
    return np.concatenate(stack)


def bowl(rng: Rng) -> Array:
    radius, depth, wall = rng.uniform(0.05, 0.12), rng.uniform(0.04, 0.08), 0.004
    tilt = np.linspace(0.35, np.pi / 2, 7)
    outer = np.stack([radius * np.sin(tilt), depth * (1 - np.cos(tilt) / np.cos(tilt[0]))], axis=1)
    inner = outer[::-1] - [wall, -wall]
    return revolve([(0, 0), *outer, *inner, (0, wall)])


def plate(rng: Rng) -> Array:
    radius = rng.uniform(0.08, 0.13)
    return revolve([(0, 0), (0.6 * radius, 0), (radius, 0.02), (radius, 0.024), (0.6 * radius, 0.005), (0, 0.005)])


def toy(rng: Rng) -> Array:
    """A body, a head and limbs of balls."""
    size = rng.uniform(0.025, 0.06)
    places = [(0, 0, 0, 1.0), (0, 0, 1.5, 0.7), (0.9, 0.3, 0.0, 0.45), (-0.8, 0.5, 0.2, 0.45), (0.2, -0.9, 0.6, 0.4)]
    return np.concatenate(
        [apply(translation(size * np.array([x, y, z])), sphere(size * r, 7)) for x, y, z, r in places]
    )


def blocks(rng: Rng) -> Array:
    """Toy bricks on one another."""
    size = rng.uniform(0.03, 0.06)
    brick = cuboid((size, size, size))
    x, y = rng.uniform(-0.2, 0.2, (2, 3)) * size
    yaw = rng.uniform(0, 2 * np.pi, 3)
    return np.concatenate([apply(standing(x[k], y[k], yaw[k], k * (size + 0.0003)), brick) for k in range(3)])


def tape(rng: Rng) -> Array:
    outer, height = rng.uniform(0.04, 0.06), rng.uniform(0.02, 0.055)
    return revolve([(0.7 * outer, 0), (outer, 0), (outer, height), (0.7 * outer, height), (0.7 * outer, 0)])


def packet(rng: Rng) -> Array:
    """A small closed box, standing or lying."""
    return cuboid(rng.permutation([rng.uniform(0.04, 0.08), rng.uniform(0.08, 0.16), rng.uniform(0.12, 0.24)]))


def cone(rng: Rng) -> Array:
    radius = rng.uniform(0.03, 0.07)
    return revolve([(0, 0), (radius, 0), (0.1 * radius, rng.uniform(0.08, 0.2)), (0, rng.uniform(0.08, 0.2))])


SHAPES = (cup, mug, bottle, can, ball, book, books, bowl, plate, toy, blocks, tape, packet, cone)


def draw_thing(rng: Rng) -> tuple[Array, tuple[int, int, int]]:
    """Triangles of a thing and its colour."""
    shape = SHAPES[int(rng.integers(len(SHAPES)))]
    red, green, blue = (int(c) for c in rng.integers(50, 240, 3))
    return shape(rng), (red, green, blue)
