"""Does perception tell what ends a segment at each side of its rectangle? Held against true panels, not against labels.

    python benchmarks/side_kinds.py SET... [--planes NAME]

SET is a folder of NAME.pcd, NAME.truth.json, NAME.labels.npz. Judged are the sides of the rectangles of panels that
are found (intersection over union of at least 0.7). A side that lies along a true edge of the panel is a crease where
readings of a panel joined there, or of the support, lie along it, else an edge. "touched" is an edge along which
readings of a panel lie that is not joined (flaps that stand up side by side): edge is right, and hard to tell. A side
along which the true panel goes on is a border at the image's rim, occluded where a reading before the panel hides it.
Others (slanted, without readings) are not judged.
"""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from planes_recall import overlaps

from boxwright.io.clouds import read_cloud
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.perception import perceive
from boxwright.types import Camera, Truth

Array = NDArray[np.float64]

KINDS = ("edge", "crease", "occluded", "border")
RIGHT = {"edge": "edge", "touched": "edge", "crease": "crease", "occluded": "occluded", "border": "border"}
"""What is right to say of a side, by what it truly is."""

MIN_READINGS, MIN_IOU = 500, 0.7
SAMPLES = 25
NEAR_M = 0.02
"""A side lies along a true edge, and readings along a side, within this."""
BEYOND_M = 0.02
"""Whether the panel goes on is looked at so far outside a side."""
HIDES_M = 0.03
RIM_PX = 6
MOST, HALF = 0.6, 0.5
"""The shares of a side's samples that decide: where it lies, and whether something lies along it."""


@dataclass(frozen=True)
class Frame:
    """A cloud with its truth; `labels` (N,) 0 for no panel."""

    truth: Truth
    points: Array
    labels: NDArray[np.int64]

    def pixels(self, points: Array) -> tuple[Array, Array]:
        """Columns and rows of points (N, 3)."""
        camera: Camera = self.truth.camera
        columns = points[:, 0] / points[:, 2] * camera.fx + camera.cx
        return columns, points[:, 1] / points[:, 2] * camera.fy + camera.cy

    def readings_at(self, points: Array) -> Array:
        """The reading (N, 3) in the pixel of each point, NaN for none."""
        camera = self.truth.camera
        columns, rows = (np.rint(values).astype(int) for values in self.pixels(points))
        inside = (columns >= 0) & (columns < camera.width) & (rows >= 0) & (rows < camera.height)
        index = np.where(inside, rows * camera.width + columns, 0)
        return np.where(inside[:, None], self.points[index], np.nan)

    def at_rim(self, points: Array) -> NDArray[np.bool_]:
        """Whether points (N, 3) project next to the image's rim."""
        columns, rows = self.pixels(points)
        camera = self.truth.camera
        across = np.minimum(columns, camera.width - 1 - columns)
        return np.asarray(np.minimum(across, np.minimum(rows, camera.height - 1 - rows)) < RIM_PX)


def true_kind(frame: Frame, part: int, side: Array, inward: Array) -> str | None:
    """What ends a panel at the side (2, 3) of its rectangle; `inward` points into the rectangle."""
    along = (np.arange(SAMPLES) + 0.5)[:, None] / SAMPLES
    samples = side[0] + along * (side[1] - side[0])
    corners = np.array(frame.truth.parts[part].corners)
    for k in range(4):
        edge = corners[k], corners[(k + 1) % 4]
        if np.mean(distances_to(samples, edge) < NEAR_M) >= MOST:
            if goes_on(frame, part, samples, edge):
                return "crease"
            others = frame.points[(frame.labels > 0) & (frame.labels != part + 1)]
            return "touched" if np.mean(near_any(samples, others)) >= HALF else "edge"
    beyond = samples - BEYOND_M * inward
    inside = within(corners, beyond)
    if np.mean(inside) < MOST:
        return None
    if np.mean(frame.at_rim(samples[inside])) >= MOST:
        return "border"
    seen = frame.readings_at(beyond[inside])
    hidden = seen[:, 2] < beyond[inside][:, 2] - HIDES_M
    return "occluded" if np.mean(hidden) >= MOST else None


def goes_on(frame: Frame, part: int, samples: Array, edge: tuple[Array, Array]) -> bool:
    """Whether readings of an adjoining panel or of the support lie along most of the edge."""
    own = frame.truth.parts[part]
    joined = np.zeros(SAMPLES, bool)
    for k, other in enumerate(frame.truth.parts):
        corners = np.array(other.corners)
        shares = any(
            max(distances_to(np.array(edge), (corners[j], corners[(j + 1) % 4]))) < NEAR_M
            or max(distances_to(np.array([corners[j], corners[(j + 1) % 4]]), edge)) < NEAR_M
            for j in range(4)
        )
        if k != part and other.box == own.box and shares:
            joined |= near_any(samples, frame.points[frame.labels == k + 1])
    if own.name.startswith("side") and is_bottom(own.corners, edge):
        joined |= near_any(samples, floor_readings(frame, samples))
    return bool(np.mean(joined) >= HALF)


def is_bottom(corners: tuple[tuple[float, ...], ...], edge: tuple[Array, Array]) -> bool:
    """A side's edge opposite to its top."""
    return bool(np.allclose(edge[0], corners[2]) and np.allclose(edge[1], corners[3]))


def floor_readings(frame: Frame, samples: Array) -> Array:
    """Unlabelled readings at the height of a side's lower edge."""
    up = np.array(frame.truth.up)
    heights = frame.points @ up - np.median(samples @ up)
    floor: Array = frame.points[(frame.labels == 0) & (np.abs(heights) < NEAR_M)]
    return floor


def near_any(samples: Array, points: Array) -> NDArray[np.bool_]:
    """Whether a point lies near each sample."""
    low, high = samples.min(axis=0) - NEAR_M, samples.max(axis=0) + NEAR_M
    close = points[np.all((points >= low) & (points <= high), axis=1)]
    gaps = np.linalg.norm(samples[:, None] - close[None], axis=2)
    return np.asarray(gaps.min(axis=1, initial=np.inf) < NEAR_M)


def distances_to(points: Array, edge: tuple[Array, Array]) -> Array:
    """Distances (N,) of points (N, 3) to a line segment."""
    run = edge[1] - edge[0]
    t = np.clip((points - edge[0]) @ run / (run @ run), 0.0, 1.0)
    return np.asarray(np.linalg.norm(points - edge[0] - t[:, None] * run, axis=1))


def within(corners: Array, points: Array) -> NDArray[np.bool_]:
    """Whether points near a convex panel's plane lie inside its corners."""
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
    runs = np.roll(corners, -1, axis=0) - corners
    turns = np.cross(runs[None], points[:, None] - corners[None]) @ normal
    return np.asarray(np.all(turns >= 0, axis=1))


def judged(folder: Path, planes: str | None) -> Iterator[tuple[str, str]]:
    """The true and the told kind of each side that is judged."""
    for path in sorted(folder.glob("*.truth.json")):
        name = path.name.removesuffix(".truth.json")
        cloud = read_cloud(folder / f"{name}.pcd")
        labels = read_truth_labels(folder / f"{name}.labels.npz").astype(np.int64)
        truth = load_truth(path)
        frame = Frame(truth, cloud.points.astype(np.float64), labels)
        seen = perceive(cloud, planes=planes)
        shared = overlaps(np.where(labels <= len(truth.parts), labels, 0), seen, len(truth.parts))
        inter = shared[1:, 1:].astype(float)
        iou = inter / np.maximum(shared[1:].sum(1)[:, None] + shared[:, 1:].sum(0)[None] - inter, 1)
        for part, s in zip(*np.nonzero(iou >= MIN_IOU), strict=True):
            if shared[part + 1].sum() < MIN_READINGS:
                continue
            rectangle = seen.rectangles[s]
            for k in range(4):
                side = rectangle[[k, (k + 1) % 4]]
                inward = rectangle[(k + 2) % 4] - rectangle[(k + 1) % 4]
                kind = true_kind(frame, int(part), side, inward / np.linalg.norm(inward))
                if kind is not None:
                    yield kind, seen.edges[s][k]


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--planes")
    options = parser.parse_args()
    counts = Counter(pair for folder in options.sets for pair in judged(folder, options.planes))
    if not counts:
        parser.error("no panel is found in the folders given")
    print(f"{'truth, sides':<18}" + "".join(f"{told:>10}" for told in KINDS) + f"{'right %':>10}")
    for kind, right in RIGHT.items():
        row = [counts[kind, told] for told in KINDS]
        share = f"{100 * counts[kind, right] / sum(row):>10.1f}" if sum(row) else f"{'-':>10}"
        print(f"{kind:<10}{sum(row):>8}" + "".join(f"{n:>10}" for n in row) + share)
    right_sides = sum(counts[pair] for pair in RIGHT.items())
    print(f"{'all':<10}{counts.total():>8}{'':>40}{100 * right_sides / counts.total():>10.1f}")


if __name__ == "__main__":
    main()
