r"""What more than one look brings: scenes seen from several places, answered frame by frame and fused.

    boxwright synth out/sets/looks --count 36 --seed 3601 --boxes 1 --views 3
    boxwright synth out/sets/looks_none --count 20 --seed 3602 --category none --views 3
    .venv/bin/python -m benchmarks.views out/sets/looks out/sets/looks_none -o docs/results/views.md

A row is a way to answer: from the first frame; from the frame whose answer came out best, which only the truth tells;
from all frames fused, with the poses as they are and with poses of all but the first frame off by as much as a row says
(Gaussian, each axis; seeded). Every row is held against the same flaps: those with 400 readings and more in all frames
together.
"""

from __future__ import annotations

import argparse
import shlex
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import BoxScore, FrameScore, score_frame
from boxwright.fusion import infer_frames
from boxwright.io.clouds import read_cloud
from boxwright.io.poses import read_poses
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.pipeline import infer
from boxwright.types import Joint, Model, PosedCloud, Truth

Array = NDArray[np.float64]

POSE_ERRORS = ((0.002, 0.2), (0.005, 0.5))
"""Metres and degrees, one standard deviation along and about each axis."""

USABLE_DEG, USABLE_M, USABLE_ANGLE_DEG = 3.0, 0.010, 5.0
"""Hinge angle, hinge distance and flap angle of a usable flap (docs/formats.md)."""

WITHIN_90 = 1.645
"""Standard deviations that hold 90 % of a Gaussian."""


@dataclass(frozen=True)
class Scene:
    """One scene's frames with their truth and labels."""

    name: str
    frames: list[PosedCloud]
    truths: list[Truth]
    labels: list[NDArray[np.uint16]]


@dataclass
class Row:
    """What one way to answer came to, over all scenes."""

    boxes: int = 0
    found: int = 0
    false_objects: int = 0
    flaps: int = 0
    right: int = 0
    wrong: int = 0
    usable: int = 0
    accuracies: list[float] = field(default_factory=list)
    hinge_deg: list[float] = field(default_factory=list)
    hinge_mm: list[float] = field(default_factory=list)
    flap_deg: list[float] = field(default_factory=list)
    size_mm: list[float] = field(default_factory=list)
    covered: list[bool] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)


def read_scene(path: Path) -> Scene:
    """The scene of a file of poses in a scene set."""
    listed = read_poses(path)
    frames = [PosedCloud(cloud=read_cloud(one.file), base_from_camera=one.base_from_camera) for one in listed]
    beside = [one.file.with_suffix("") for one in listed]
    truths = [load_truth(f"{stem}.truth.json") for stem in beside]
    return Scene(path.name, frames, truths, [read_truth_labels(f"{stem}.labels.npz") for stem in beside])


def moved(frames: list[PosedCloud], sigma_m: float, sigma_deg: float, seed: int) -> list[PosedCloud]:
    """The frames with poses that are off, but for the first one's."""
    rng = np.random.default_rng((seed, 90))
    out = frames[:1]
    for frame in frames[1:]:
        turn, shift = rng.normal(0.0, np.radians(sigma_deg), 3), rng.normal(0.0, sigma_m, 3)
        off = np.eye(4)
        off[:3, :3], off[:3, 3] = _rotation(turn), shift
        out = [*out, PosedCloud(cloud=frame.cloud, base_from_camera=frame.base_from_camera @ off)]
    return out


def _rotation(turn_rad: Array) -> Array:
    angle = float(np.linalg.norm(turn_rad))
    x, y, z = turn_rad / max(angle, 1e-12)
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * skew + (1.0 - np.cos(angle)) * skew @ skew)


def measure(scenes: list[Scene]) -> dict[str, Row]:
    """The rows of the table, by name."""
    names = ["first frame", "best frame", "fused"]
    names += [f"fused, poses off by {1000 * m:.0f} mm, {deg} deg" for m, deg in POSE_ERRORS]
    rows = {name: Row() for name in names}
    for number, scene in enumerate(scenes):
        singles = [_single(scene, k) for k in range(len(scene.frames))]
        _add(rows["first frame"], *singles[0], scene)
        _add(rows["best frame"], *max(singles, key=lambda one: _merit(one[0])), scene)
        _add(rows["fused"], *_fused(scene, scene.frames), scene)
        for name, (sigma_m, sigma_deg) in zip(names[3:], POSE_ERRORS, strict=True):
            _add(rows[name], *_fused(scene, moved(scene.frames, sigma_m, sigma_deg, number)), scene)
    return rows


Answered = tuple[FrameScore, Model, float]


def _single(scene: Scene, k: int) -> Answered:
    start = time.perf_counter()
    inferred = infer(scene.frames[k].cloud)
    seconds = time.perf_counter() - start
    labels = inferred.object_labels, inferred.part_labels
    return score_frame(inferred.model.objects, *labels, scene.truths[k], scene.labels[k]), inferred.model, seconds


def _fused(scene: Scene, frames: list[PosedCloud]) -> Answered:
    start = time.perf_counter()
    fused = infer_frames(frames)
    seconds = time.perf_counter() - start
    objects = np.concatenate([labels.object for labels in fused.labels])
    parts = np.concatenate([labels.part for labels in fused.labels])
    score = score_frame(fused.model.objects, objects, parts, scene.truths[0], np.concatenate(scene.labels))
    return score, fused.model, seconds


def _merit(score: FrameScore) -> tuple[int, float]:
    errors = [error.hinge_distance_m for box in score.boxes for error in box.flap_errors]
    return sum(box.flaps_right - box.flaps_wrong for box in score.boxes), -float(np.mean(errors or [1.0]))


def _add(row: Row, score: FrameScore, model: Model, seconds: float, scene: Scene) -> None:
    readings = np.bincount(np.concatenate(scene.labels), minlength=len(scene.truths[0].parts) + 1)[1:]
    parts = zip(scene.truths[0].parts, readings, strict=True)
    row.flaps += sum(count >= 400 and part.name.startswith("flap") for part, count in parts)
    row.boxes += len(scene.truths[0].boxes)
    row.false_objects += score.false_objects
    row.seconds.append(seconds)
    for box in score.boxes:
        row.found += box.object is not None
        row.right += box.flaps_right
        row.wrong += box.flaps_wrong
        if box.flap_accuracy is not None:
            row.accuracies.append(box.flap_accuracy)
        _add_errors(row, box, model)


def _add_errors(row: Row, box: BoxScore, model: Model) -> None:
    row.size_mm += [1000.0 * error for error in box.dimension_errors_m or ()]
    joints = {joint.child: joint for joint in model.objects[box.object].joints} if box.object is not None else {}
    name_of = {verdict.role: verdict.name for verdict in box.verdicts}
    for error in box.flap_errors:
        hinge_deg, flap_deg = np.degrees(error.hinge_angle_rad), np.degrees(error.flap_angle_rad)
        row.hinge_deg.append(float(hinge_deg))
        row.hinge_mm.append(1000.0 * error.hinge_distance_m)
        row.flap_deg.append(float(flap_deg))
        is_near = error.hinge_distance_m <= USABLE_M and flap_deg <= USABLE_ANGLE_DEG
        row.usable += bool(is_near and hinge_deg <= USABLE_DEG)
        row.covered.append(_is_covered(joints[name_of[error.flap]], error.flap_angle_rad))


def _is_covered(joint: Joint, angle_error_rad: float) -> bool:
    return joint.sigma is not None and angle_error_rad <= WITHIN_90 * joint.sigma.position


def table(rows: dict[str, Row]) -> str:
    """As Markdown."""
    head = (
        "answer", "boxes found", "false", "flap acc. %", "flaps right / wrong / in all frames", "usable %",
        "hinge deg", "hinge mm", "flap deg", "dimension mm", "flap angle in its 90 % interval %", "ms",
    )  # fmt: skip
    lines = ["| " + " | ".join(head) + " |", "| --- |" + " ---: |" * (len(head) - 1)]
    for name, row in rows.items():
        cells = (
            name,
            f"{row.found} / {row.boxes}",
            str(row.false_objects),
            f"{100 * float(np.mean(row.accuracies or [0.0])):.1f}",
            f"{row.right} / {row.wrong} / {row.flaps}",
            f"{100 * row.usable / max(row.flaps, 1):.1f}",
            *(_median_and_90(values) for values in (row.hinge_deg, row.hinge_mm, row.flap_deg, row.size_mm)),
            f"{100 * float(np.mean(row.covered or [False])):.0f}",
            f"{1000 * float(np.median(row.seconds)):.0f}",
        )
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def _median_and_90(values: list[float]) -> str:
    if not values:
        return "-"
    return f"{np.median(values):.2f} / {np.percentile(values, 90):.2f}"


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, metavar="SET", help="a set made with --views")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.md", help="write the page there too")
    options = parser.parse_args()
    scenes = []
    for folder in options.folders:
        files = sorted(folder.glob("*.poses.toml"))
        if not files:
            parser.error(f"{folder} holds no NAME.poses.toml; boxwright synth --views 3 writes them")
        scenes += [read_scene(path) for path in files]
    text = table(measure(scenes))
    command = shlex.join(["python", "-m", "benchmarks.views", *sys.argv[1:]])
    of = f"{len(scenes)} scenes, {sum(len(scene.frames) for scene in scenes)} frames"
    page = f"# Several looks at one scene\n\n`{command}`\n\n{of}. Errors are median / 90th percentile.\n\n{text}"
    print(page)
    if options.output is not None:
        options.output.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
