"""Panels found in fused clouds: one scene seen from several sides, without an image grid, z up.

    python benchmarks/fused_recall.py [--scenes 12] [--views 5] [--points 100000] [--planes grid ransac] [--save DIR]

Each view of a scene is put where its camera was, with a small error of its own; readings are drawn from all of them.
A panel counts from 500 readings on; it is found where one segment's readings and its own have an intersection over
union of at least 0.5. Precision: of the segments that lie mostly on labelled panels, the share that finds one.
"""

from __future__ import annotations

import argparse
import time
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np
from machine import cpu_name
from numpy.typing import NDArray

from boxwright.perception import Perception, perceive
from boxwright.simulation.drawing import CATEGORIES, draw_scene
from boxwright.simulation.frames import kinect_camera, render
from boxwright.simulation.views import look_at
from boxwright.types import Cloud

MIN_READINGS = 500
SMALL_READINGS = 1500
MIN_IOU = 0.5
ELEVATIONS_DEG = (35.0, 60.0)
DISTANCES_M = (0.9, 1.4)
FARTHEST_M = 1.2
"""From the boxes' middle, along the floor: what lies beyond is cut off, as people do with fused clouds."""
SHIFT_SIGMA_M = 0.001
TURN_SIGMA_RAD = 0.001

Labels = NDArray[np.int64]
Points = NDArray[np.float32]


@dataclass(frozen=True)
class Fused:
    name: str
    points: Points
    labels: Labels
    """Index of the panel + 1, 0 for none."""


@dataclass(frozen=True)
class Verdict:
    seconds: float
    panels: list[tuple[int, float]]
    """Readings and best IoU of each panel that counts."""
    precise: list[bool]
    up_error_deg: float


def fuse(category: str, seed: int, index: int, views: int) -> Fused:
    """One scene of the simulation's sequence from `views` cameras around it; world frame, metres."""
    camera = kinect_camera()
    rng = np.random.default_rng((seed, index))
    scene = draw_scene(rng, category, camera, None, clutter=True)
    corners = np.concatenate([box.triangles_world() for box in scene.boxes]).reshape(-1, 3)
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    first = rng.uniform(0, 2 * np.pi)
    parts = []
    for k in range(views):
        azimuth = first + 2 * np.pi * k / views
        pose = look_at(middle, azimuth, np.radians(rng.uniform(*ELEVATIONS_DEG)), rng.uniform(*DISTANCES_M), 0.0)
        frame = render(msgspec.structs.replace(scene, camera_from_world=pose), camera, int(rng.integers(2**62)), "view")
        seen = np.isfinite(frame.points).all(axis=1)
        parts.append((in_world(frame.points[seen], pose, rng), frame.labels[seen]))
    points = np.concatenate([p for p, _ in parts])
    labels = np.concatenate([b for _, b in parts]).astype(np.int64)
    near = np.linalg.norm(points[:, :2] - middle[:2], axis=1) < FARTHEST_M
    return Fused(f"{category}_{index:04d}", points[near].astype(np.float32), labels[near])


def in_world(points: Points, camera_from_world: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Camera to world, by a pose that is a little wrong."""
    x, y, z = rng.normal(0, TURN_SIGMA_RAD, 3)
    wrong = np.array([[1, -z, y], [z, 1, -x], [-y, x, 1]])
    rotation, shift = camera_from_world[:3, :3], camera_from_world[:3, 3]
    moved: NDArray[np.float64] = (
        points.astype(np.float64) @ wrong.T + rng.normal(0, SHIFT_SIGMA_M, 3) - shift
    ) @ rotation
    return moved


def thinned(cloud: Fused, count: int, rng: np.random.Generator) -> Fused:
    """`count` of the readings in random order; all where there are fewer."""
    chosen = rng.permutation(len(cloud.points))[:count]
    return Fused(cloud.name, np.ascontiguousarray(cloud.points[chosen]), cloud.labels[chosen])


def judge(cloud: Fused, seen: Perception, seconds: float) -> Verdict:
    panels = int(cloud.labels.max())
    flat = cloud.labels * (len(seen) + 1) + (seen.labels.astype(np.int64) + 1)
    shared = np.bincount(flat, minlength=(panels + 1) * (len(seen) + 1)).reshape(panels + 1, len(seen) + 1)
    panel_sizes, segment_sizes = shared[1:].sum(1), shared[:, 1:].sum(0)
    inter = shared[1:, 1:].astype(float)
    iou = inter / np.maximum(panel_sizes[:, None] + segment_sizes[None, :] - inter, 1)
    counted = [k for k in range(panels) if panel_sizes[k] >= MIN_READINGS]
    on_panels = inter.sum(0) >= 0.5 * np.maximum(segment_sizes, 1)
    return Verdict(
        seconds,
        [(int(panel_sizes[k]), float(iou[k].max(initial=0.0))) for k in counted],
        [bool(iou[:, s].max() >= MIN_IOU) for s in range(len(seen)) if on_panels[s]],
        float(np.degrees(np.arccos(np.clip(seen.up[2], -1, 1)))),
    )


def report(planes: str, verdicts: list[Verdict]) -> None:
    panels = [p for v in verdicts for p in v.panels]
    found = [iou >= MIN_IOU for _, iou in panels]
    small = [iou >= MIN_IOU for size, iou in panels if size < SMALL_READINGS]
    precise = [p for v in verdicts for p in v.precise]
    print(
        f"{planes:<8} recall {np.mean(found):.3f} of {len(found)}, of panels below {SMALL_READINGS} readings "
        f"{np.mean(small) if small else float('nan'):.3f} of {len(small)}, "
        f"precision {np.mean(precise):.3f} of {len(precise)}, "
        f"up wrong by > 2 deg {sum(v.up_error_deg > 2 for v in verdicts)} of {len(verdicts)}, "
        f"ms {1000 * float(np.median([v.seconds for v in verdicts])):.0f} (CPU, median)"
    )


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", type=int, default=12)
    parser.add_argument("--views", type=int, default=5)
    parser.add_argument("--points", type=int, nargs="+", default=[100_000])
    parser.add_argument("--planes", nargs="+", default=["grid", "ransac"])
    parser.add_argument("--seed", type=int, default=4000)
    parser.add_argument("--save", type=Path, help="a folder that keeps the fused clouds as NAME.npz")
    options = parser.parse_args()
    print(cpu_name())
    clouds = [cached(options, CATEGORIES[k % len(CATEGORIES)], k) for k in range(options.scenes)]
    for count in options.points:
        print(f"{count} readings of each of {len(clouds)} scenes, {options.views} views")
        thin = [thinned(cloud, count, np.random.default_rng((count, k))) for k, cloud in enumerate(clouds)]
        for planes in options.planes:
            report(planes, [verdict(cloud, planes) for cloud in thin])


def cached(options: argparse.Namespace, category: str, index: int) -> Fused:
    path = options.save and options.save / f"{category}_{index:04d}_{options.seed}_{options.views}.npz"
    if path and path.exists():
        stored = np.load(path)
        return Fused(path.stem, stored["points"], stored["labels"])
    cloud = fuse(category, options.seed, index, options.views)
    if path:
        path.parent.mkdir(parents=True, exist_ok=True)
        np.savez(path, points=cloud.points, labels=cloud.labels)
    return cloud


def verdict(cloud: Fused, planes: str) -> Verdict:
    start = time.process_time()
    seen = perceive(Cloud(points=cloud.points, width=len(cloud.points), height=1), planes=planes)
    return judge(cloud, seen, time.process_time() - start)


if __name__ == "__main__":
    main()
