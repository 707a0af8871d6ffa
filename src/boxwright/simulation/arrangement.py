"""Puts boxes and things into the world so that nothing passes through anything."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.boxes import OpenBox
from boxwright.simulation.clearance import free_flaps, is_clear_of
from boxwright.simulation.clutter import draw_thing
from boxwright.simulation.kinds import draw_box
from boxwright.simulation.meshes import cuboid
from boxwright.simulation.panels import outline
from boxwright.simulation.poses import apply, rotation, standing, translation
from boxwright.simulation.scene import Body, PlacedBox, place
from boxwright.simulation.states import LYING

Array = NDArray[np.float64]
Rng = np.random.Generator

TRIES = 500
"""Few draws of a box on a side keep its open flaps clear of the ground; a set of sixty has one that took 31."""
GROUND_GAP_M = 0.0002
THING_GAP_M = 0.001
"""A thing that touches a box keeps this much from it."""
STANDS_COS = 0.9
"""Nothing is put on the base of a box that leans more."""
STEP_M = 0.01
SPOTS = ("touching", "inside", "around")


def arrange_boxes(
    rng: Rng, category: str, count: int, variant: str | None = None
) -> tuple[list[PlacedBox], list[Body]]:
    """Open boxes centimetres apart, the first at the origin, now and then one tilted on a book; and those books."""
    boxes: list[PlacedBox] = []
    books: list[Body] = []
    for _ in range(count):
        placed, book = _freed_box(rng, category, variant, is_tilted=rng.random() < 0.1)
        standing_at = _beside(rng, _footprint(placed, book), _all_triangles(boxes, books), rng.uniform(0.01, 0.08))
        boxes.append(msgspec.structs.replace(placed, world_from_box=standing_at @ placed.world_from_box))
        books += [Body(apply(standing_at, one.triangles), one.color) for one in book]
    return boxes, books


def _freed_box(rng: Rng, category: str, variant: str | None, *, is_tilted: bool) -> tuple[PlacedBox, list[Body]]:
    """A box at the origin whose boards keep clear of each other, and the book under it if it is tilted."""
    for _ in range(TRIES):
        box = draw_box(rng, category, variant)
        if category == LYING:
            box, world_from_box = _lie(rng, box)
            book: list[Body] = []
        else:
            world_from_box, book = _tilt(rng, box) if is_tilted else (np.eye(4), [])
        freed = free_flaps(rng, box, world_from_box)
        if freed is None:
            continue
        placed = place(freed, world_from_box)
        if is_clear_of(placed.triangles_world(), [one.triangles for one in book], GROUND_GAP_M):
            return placed, book
    raise RuntimeError(
        f"no {category} box whose boards keep clear of each other in {TRIES} draws; a fault of the kinds' sizes"
    )


def _tilt(rng: Rng, box: OpenBox) -> tuple[Array, list[Body]]:
    """The box turned about the lower edge of one of its long sides, a book under the other."""
    angle_rad = float(np.radians(rng.uniform(2.5, 7.0)))
    pivot = -(box.width_m + box.board_m) / 2 * np.cos(box.rack_rad)
    world_from_box = translation([0, 0, GROUND_GAP_M]) @ rotation([1, 0, 0], angle_rad) @ translation([0, -pivot, 0])
    under_m = rng.uniform(0.6, 0.9) * box.width_m
    size = (rng.uniform(0.6, 1.1) * box.length_m, 0.25, under_m * np.sin(angle_rad) - 0.0005)
    place_book = translation([rng.normal(0, 0.02), under_m * np.cos(angle_rad) + size[1] / 2, 0])
    return world_from_box, [Body(apply(place_book, cuboid(size)), (120, 60, 60))]


def _lie(rng: Rng, box: OpenBox) -> tuple[OpenBox, Array]:
    """The box on one of its sides, which is flat then."""
    k = int(rng.integers(4))
    first, second, third, fourth = (0.0 if side == k else bulge for side, bulge in enumerate(box.bulges_m))
    start, end = outline(box, box.board_m / 2)[[k, (k + 1) % 4]]
    edge = np.append(end - start, 0.0) / np.linalg.norm(end - start)
    # Outwards of the side, and down once the box has turned about the side's lower edge.
    out = np.cross(edge, [0.0, 0.0, 1.0])
    turn = rotation(np.cross(out, [0.0, 0.0, -1.0]), np.pi / 2)
    lift = translation([0, 0, GROUND_GAP_M]) @ turn @ translation(-np.append(start, 0.0))
    middle = apply(lift, np.array([0.0, 0.0, box.height_m / 2]))
    laid = msgspec.structs.replace(box, bulges_m=(first, second, third, fourth))
    return laid, translation([-middle[0], -middle[1], 0]) @ lift


def _footprint(placed: PlacedBox, book: list[Body]) -> Array:
    return np.concatenate([placed.triangles_world(), *(one.triangles for one in book)])


def _all_triangles(boxes: list[PlacedBox], bodies: list[Body]) -> list[Array]:
    return [box.triangles_world() for box in boxes] + [body.triangles for body in bodies]


def _beside(rng: Rng, body: Array, others: list[Array], gap_m: float) -> Array:
    """A pose at which the body, slid in from a random direction, stands `gap_m` from the nearest of the others."""
    yaw, heading = rng.uniform(0, 2 * np.pi, 2)
    if not others:
        return standing(0, 0, yaw)
    turned = apply(standing(0, 0, yaw), body)
    away = np.array([np.cos(heading), np.sin(heading), 0.0])
    everything = np.concatenate(others)
    # Beyond this no point of one can touch a point of the other.
    distance_m = float((everything @ away).max() - (turned @ away).min() + gap_m + STEP_M)
    while distance_m > STEP_M and is_clear_of(turned + (distance_m - STEP_M) * away, others, gap_m):
        distance_m -= STEP_M
    return standing(distance_m * away[0], distance_m * away[1], yaw)


def arrange_clutter(rng: Rng, boxes: list[PlacedBox], present: list[Body], reach_m: tuple[float, float]) -> list[Body]:
    """Things around, touching and inside the boxes; all within `reach_m` of the origin in x and y."""
    added: list[Body] = []
    for near in boxes:
        spots = ["inside"] * int(rng.choice(3, p=(0.55, 0.3, 0.15))) + ["touching"] * int(
            rng.choice(3, p=(0.5, 0.35, 0.15))
        )
        for spot in spots:
            added += _put(rng, spot, boxes, present + added, near, reach_m)
    for _ in range(int(rng.integers(0, 7))):
        added += _put(rng, "around", boxes, present + added, None, reach_m)
    return added


def arrange_things(
    rng: Rng, boxes: list[PlacedBox], present: list[Body], reach_m: tuple[float, float], count: int
) -> list[Body]:
    """As `arrange_clutter`, of a number of things; where one finds no place it is left out."""
    added: list[Body] = []
    for k in range(count):
        spot = SPOTS[k % len(SPOTS)] if boxes else "around"
        near = boxes[k // len(SPOTS) % len(boxes)] if boxes else None
        added += _put(rng, spot, boxes, present + added, near, reach_m)
    return added


def _put(
    rng: Rng,
    spot: str,
    boxes: list[PlacedBox],
    bodies: list[Body],
    near: PlacedBox | None,
    reach_m: tuple[float, float],
) -> list[Body]:
    """One thing, or none where none fits."""
    thing, color = draw_thing(rng)
    others = _all_triangles(boxes, bodies)
    for _ in range(4):
        if spot == "inside" and near is not None:
            pose = _inside(rng, near, thing)
        elif spot == "touching" and near is not None:
            pose = _beside(rng, thing, [near.triangles_world()], 2 * THING_GAP_M)
        else:
            pose = _around(rng)
        if pose is None:
            return []
        moved = apply(pose, thing)
        is_on_support = spot == "inside" or bool((np.abs(moved[..., :2]).max(axis=(0, 1)) < reach_m).all())
        if is_on_support and is_clear_of(moved, others, THING_GAP_M):
            return [Body(moved, color)]
    return []


def _around(rng: Rng) -> Array:
    x, y = rng.uniform(-0.8, 0.8, 2)
    return standing(x, y, rng.uniform(0, 2 * np.pi))


def _inside(rng: Rng, placed: PlacedBox, thing: Array) -> Array | None:
    """On the box's base, if the thing's circle fits between the sides."""
    box = placed.box
    if box.is_closed or placed.world_from_box[2, 2] < STANDS_COS:
        return None
    radius = float(np.linalg.norm(thing[..., :2], axis=-1).max())
    room = np.array([box.length_m, box.width_m]) / 2 - box.board_m - radius - 0.02
    if (room < 0).any() or thing[..., 2].max() > box.height_m + 0.15:
        return None
    x, y = rng.uniform(-room, room)
    return placed.world_from_box @ standing(x, y, rng.uniform(0, 2 * np.pi), box.board_m + 0.0015)
