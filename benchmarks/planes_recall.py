"""How many of the true panels does perception find? The paper says "almost 100 %".

    python benchmarks/planes_recall.py SET... [--planes NAME] [--list-missed] [--json OUT]

SET is a folder of NAME.pcd, NAME.truth.json, NAME.labels.npz. A panel counts from 500 readings on; it is found where
one segment's readings and its own have an intersection over union of at least 0.5. Precision: of the segments that lie
mostly on labelled panels, the share that finds one. A box is whole where all panels found are in one group.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.io.clouds import read_cloud
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.perception import Perception, perceive
from boxwright.types import Truth

MIN_READINGS = 500
SMALL_READINGS = 1500
MIN_IOU = 0.5
ROLES = ("base", "side", "flap", "tuck")


@dataclass(frozen=True)
class Frame:
    """What one frame says: up and support against the truth, each panel, each segment."""

    name: str
    seconds: float
    up_error_deg: float
    panels: list[tuple[str, int, float, float]]
    """Name with its box, readings, best IoU, share of the panel's readings in any segment."""
    precise: list[bool]
    """Of each segment that lies mostly on panels: whether it finds one."""
    clutter_segments: int
    split_boxes: int
    boxes: int


def overlaps(labels: NDArray[np.int64], seen: Perception, parts: int) -> NDArray[np.int64]:
    """(parts + 1, S + 1) readings with each label (0: none) in each segment (column 0: none)."""
    flat = labels * (len(seen) + 1) + (seen.labels.astype(np.int64) + 1)
    return np.bincount(flat, minlength=(parts + 1) * (len(seen) + 1)).reshape(parts + 1, len(seen) + 1)


def judge(name: str, truth: Truth, labels: NDArray[np.int64], seen: Perception, seconds: float) -> Frame:
    """Matches one frame's segments with its panels."""
    shared = overlaps(labels, seen, len(truth.parts))
    panel_sizes, segment_sizes = shared[1:].sum(1), shared[:, 1:].sum(0)
    inter = shared[1:, 1:].astype(float)
    union = panel_sizes[:, None] + segment_sizes[None, :] - inter
    iou = inter / np.maximum(union, 1)
    counted = [k for k in range(len(truth.parts)) if panel_sizes[k] >= MIN_READINGS]
    best = iou.max(1, initial=0.0)
    panels = [
        (
            f"{truth.parts[k].box}:{truth.parts[k].name}",
            int(panel_sizes[k]),
            float(best[k]),
            inter[k].sum() / panel_sizes[k],
        )
        for k in counted
    ]
    on_panels = inter.sum(0) >= 0.5 * np.maximum(segment_sizes, 1)
    precise = [bool(iou[:, s].max() >= MIN_IOU) for s in range(len(seen)) if on_panels[s]]
    groups_of_box = defaultdict(set)
    for k in counted:
        if best[k] >= MIN_IOU:
            groups_of_box[truth.parts[k].box].add(int(seen.groups[int(np.argmax(iou[k]))]))
    up_error = np.degrees(np.arccos(np.clip(np.dot(seen.up, truth.up), -1, 1)))
    return Frame(
        name=name,
        seconds=seconds,
        up_error_deg=float(up_error),
        panels=panels,
        precise=precise,
        clutter_segments=int(np.sum(~on_panels)),
        split_boxes=sum(len(groups) > 1 for groups in groups_of_box.values()),
        boxes=len(groups_of_box),
    )


def frames(folder: Path, planes: str | None) -> Iterator[Frame]:
    """Perceives every frame of a set, in the order of their names."""
    for path in sorted(folder.glob("*.truth.json")):
        name = path.name.removesuffix(".truth.json")
        truth = load_truth(path)
        cloud = read_cloud(folder / f"{name}.pcd")
        labels = read_truth_labels(folder / f"{name}.labels.npz").astype(np.int64)
        start = time.perf_counter()
        try:
            seen = perceive(cloud, planes=planes)
        except ValueError as error:
            print(f"{name}: {error}", file=sys.stderr)
            continue
        yield judge(name, truth, labels, seen, time.perf_counter() - start)


def rows(judged: list[Frame]) -> dict[str, tuple[int, int]]:
    """Found and counted panels by role, by size and in all."""
    found: dict[str, list[bool]] = defaultdict(list)
    for name, size, iou, _ in (panel for frame in judged for panel in frame.panels):
        role = next((r for r in ROLES if name.split(":")[1].startswith(r)), "other")
        size_class = "small (< 1500 readings)" if size < SMALL_READINGS else "large"
        for key in (role, size_class, "all"):
            found[key].append(iou >= MIN_IOU)
    return {key: (sum(hits), len(hits)) for key, hits in found.items()}


def report(judged: list[Frame], list_missed: bool) -> None:
    """Prints the table."""
    print(f"{'panels >= 500 readings':<28}{'found':>8}{'there':>8}{'recall %':>10}")
    for key, (hits, there) in sorted(rows(judged).items()):
        print(f"{key:<28}{hits:>8}{there:>8}{100 * hits / there:>10.1f}")
    precise = [p for frame in judged for p in frame.precise]
    print(f"{'segments on panels, precise':<28}{sum(precise):>8}{len(precise):>8}{100 * np.mean(precise):>10.1f}")
    boxes, split = sum(f.boxes for f in judged), sum(f.split_boxes for f in judged)
    print(
        f"boxes whole: {boxes - split} of {boxes}; segments off the panels: {sum(f.clutter_segments for f in judged)}"
    )
    seconds = [f.seconds for f in judged]
    worst = max(judged, key=lambda f: f.up_error_deg)
    wrong = sum(f.up_error_deg > 1.5 for f in judged)
    print(f"up: {wrong} of {len(judged)} frames off by > 1.5 deg, worst {worst.up_error_deg:.2f} deg ({worst.name})")
    print(f"seconds a frame: median {np.median(seconds):.3f}, worst {max(seconds):.3f}")
    for frame in judged if list_missed else []:
        for name, size, iou, covered in frame.panels:
            if iou < MIN_IOU:
                print(f"missed: {frame.name:<24}{name:<12}{size:>7} readings, IoU {iou:.2f}, in segments {covered:.2f}")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--planes", help="the front end; the default's where not said")
    parser.add_argument("--list-missed", action="store_true")
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    judged = [frame for folder in options.sets for frame in frames(folder, options.planes)]
    if not judged:
        parser.error("no NAME.truth.json in the folders given")
    report(judged, options.list_missed)
    if options.json:
        table = {key: {"found": hits, "there": there} for key, (hits, there) in rows(judged).items()}
        options.json.write_text(json.dumps(table, indent=2) + "\n")


if __name__ == "__main__":
    main()
