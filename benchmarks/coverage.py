r"""How often the truth lies within what the fit is sure of, and the scales that make it so.

    .venv/bin/python -m benchmarks.coverage out/sets/judge --scales
    .venv/bin/python -m benchmarks.coverage out/sets/boxes -o docs/results/coverage.md

Of every right flap its hinge (origin by coordinate, axis, position), of every found box its dimensions: the share of
errors within 1.645 of the told standard deviation, which is 90 % of a normal distribution. Seen are hinges on a side
with readings, lengths between two sides with readings and heights under one; the rest follows from the body. The
scales are what the told deviations must be multiplied by for 90 % of these frames: those of
`core/src/fit/settings.rs`, times these.
"""

from __future__ import annotations

import argparse
import math
import shlex
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

from boxwright.evaluation import BoxScore, LabelledFrame, SetEntry, list_set, read_entry, score_frame
from boxwright.evaluation.roles import from_truth_name
from boxwright.io.clouds import read_cloud
from boxwright.parallel import ordered_map, processors
from boxwright.pipeline import infer
from boxwright.types import Object

QUANTITIES = ("dimension", "origin", "axis", "position")
WITHIN = 1.645
"""Standard deviations that hold 90 % of a normal distribution."""
Ratios = dict[tuple[str, str], list[float]]
"""Errors over told deviations, by quantity and whether it was seen."""


def ratios_of(entry: SetEntry) -> Ratios:
    """Of one frame; boxes without a fitted body tell none, nor does a frame that is refused."""
    frame = read_entry(entry)
    try:
        inferred = infer(read_cloud(entry.cloud_path), method="fitted")
    except ValueError as error:
        print(f"{entry.name} is left out: {error}", file=sys.stderr)
        return {}
    objects = inferred.model.objects
    score = score_frame(objects, inferred.object_labels, inferred.part_labels, frame.truth, frame.labels)
    out: Ratios = defaultdict(list)
    for box in score.boxes:
        if box.object is not None and box.rotation is not None:
            _dimensions(objects[box.object], box, out)
            _hinges(objects[box.object], box, frame, out)
    return out


def _dimensions(found: Object, box: BoxScore, out: Ratios) -> None:
    seen = {part.name for part in found.parts if part.observed}
    bounds = (("side_1", "side_3"), ("side_0", "side_2"))
    is_seen = [all(side in seen for side in sides) for sides in bounds]
    is_seen.append(any(name.startswith("side") for name in seen))
    # Errors come under the truth's names: a quarter turn swaps length and width.
    order = (1, 0, 2) if (box.rotation or 0) % 2 else (0, 1, 2)
    for error, place in zip(box.dimension_errors_m or (), order, strict=False):
        told = found.parameters.get(("length", "width", "height")[place])
        if told is not None and told.sigma:
            out["dimension", _name(is_seen[place])].append(error / told.sigma)


def _hinges(found: Object, box: BoxScore, frame: LabelledFrame, out: Ratios) -> None:
    seen = {part.name for part in found.parts if part.observed}
    role_of = {verdict.role: verdict.name for verdict in box.verdicts}
    truth = {from_truth_name(part.name): part for part in frame.truth.parts if part.box == box.box}
    for error in box.flap_errors:
        (joint,) = (joint for joint in found.joints if joint.child == role_of[error.flap])
        if joint.sigma is None:
            continue
        start, end = np.array(truth[error.flap].corners[:2])
        off = np.abs(np.array(joint.origin) - (start + end) / 2.0) / np.array(joint.sigma.origin)
        name = _name(joint.parent in seen)
        out["origin", name] += off.tolist()
        out["axis", name].append(error.hinge_angle_rad / joint.sigma.axis)
        out["position", name].append(error.flap_angle_rad / joint.sigma.position)


def _name(is_seen: bool) -> str:
    return "seen" if is_seen else "follows"


def report(ratios: Ratios, frames: int, command: str) -> str:
    """The shares within 90 % intervals, as Markdown."""
    lines = ["# How sure it is, and how often rightly", "", f"`{command}`", ""]
    lines += [f"{frames} frames. Truth within the told 90 % interval, % (how many were asked):", ""]
    lines += ["| | seen | follows from the body |", "| --- | ---: | ---: |"]
    for quantity in (*QUANTITIES, "all"):
        cells = []
        for name in ("seen", "follows"):
            asked = [q for q in QUANTITIES if quantity in (q, "all")]
            values = np.array([value for q in asked for value in ratios[q, name]])
            cells.append(f"{100 * np.mean(values <= WITHIN):.1f} ({values.size})" if values.size else "-")
        lines.append(f"| {quantity} | {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Reports, or tells the scales."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path, metavar="SET")
    parser.add_argument("--scales", action="store_true", help="tell what the deviations must be multiplied by")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.md", help="write the table there too")
    options = parser.parse_args()
    entries = [entry for folder in options.sets for entry in list_set(folder)]
    ratios: Ratios = defaultdict(list)
    for one in ordered_map(ratios_of, entries, processors()):
        for key, values in one.items():
            ratios[key] += values
    text = report(ratios, len(entries), shlex.join(["python", "-m", "benchmarks.coverage", *sys.argv[1:]]))
    print(text)
    if options.scales:
        for key in sorted(ratios):
            quantile = float(np.quantile(ratios[key], 0.9)) if ratios[key] else math.nan
            print(f"{key[0]}, {key[1]}: times {quantile / WITHIN:.3f} ({len(ratios[key])})")
    if options.output is not None:
        options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
