"""What stands in the way: figures by how much is seen of a box, and pictures of frames from best to worst.

    python -m benchmarks.gallery SET EVALUATION.json -o FOLDER

EVALUATION.json is what `boxwright evaluate SET -o EVALUATION.json` wrote. FOLDER gets README.md, with the figures by
panels in the cloud and by boxes in the frame and each lost flap's cause, and gallery.png: the best, the middle and the
worst frames, what was told in colour, true panels that no right part holds outlined in red.
"""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from boxwright.evaluation import list_set, read_entry
from boxwright.figures.canvas import save_png, show
from boxwright.figures.images import faint, seen_image
from boxwright.figures.overlays import draw_objects
from boxwright.figures.view import view_of
from boxwright.io.clouds import read_cloud
from boxwright.pipeline import infer

WORST, COLUMNS = 10, 4
LEAST_PANELS = 3
"""Fewer are no box (docs/maths.md, "Whether it is one")."""
MISSED = "#d62728"
Box = dict[str, Any]


def boxes_of(evaluation: dict[str, Any]) -> Iterator[tuple[int, Box]]:
    """Each box with how many there are in its frame."""
    for frame in evaluation["frames"]:
        for box in frame["boxes"]:
            yield len(frame["boxes"]), box


def full_share(box: Box) -> float:
    """Full model accuracy of one box."""
    return float((box["panels_right"] - box["panels_wrong"]) / box["panels_in_cloud"])


def flap_share(box: Box) -> float:
    """Flap accuracy of one box that has flaps in the cloud."""
    return float((box["flaps_right"] - box["flaps_wrong"]) / box["flaps_in_cloud"])


def table(name: str, boxes: list[tuple[int, Box]], of: Callable[[int, Box], str]) -> list[str]:
    """Accuracy of boxes by what `of` says of them, as Markdown."""
    lines = [f"| {name} | boxes | missed | flap % | full % |", "|---|---:|---:|---:|---:|"]
    for value in sorted({of(count, box) for count, box in boxes}):
        lines.append(row(value, [box for count, box in boxes if of(count, box) == value]))
    return [*lines, ""]


def row(value: str, some: list[Box]) -> str:
    """Accuracy of some boxes, as a line of a table."""
    flaps = [flap_share(box) for box in some if box["flaps_in_cloud"]]
    flap = f"{100 * np.mean(flaps):.1f}" if flaps else "-"
    missed = sum(box["object"] is None for box in some)
    return f"| {value} | {len(some)} | {missed} | {flap} | {100 * np.mean([*map(full_share, some)]):.1f} |"


def by_panels(boxes: list[tuple[int, Box]]) -> list[str]:
    """By how many panels are in the cloud, and of all that show enough of them to be told."""
    *lines, end = table("panels of the box in the cloud", boxes, lambda _, box: panels_seen(box))
    told = [box for _, box in boxes if box["panels_in_cloud"] >= LEAST_PANELS]
    return [*lines, row(f"{LEAST_PANELS} and more, which may be told", told), end]


def panels_seen(box: Box) -> str:
    """How many panels of it are in the cloud, in words that sort."""
    count = box["panels_in_cloud"]
    return "1 or 2" if count < LEAST_PANELS else "3 to 5" if count < 6 else "6 and more"


def causes(boxes: list[tuple[int, Box]]) -> list[str]:
    """Points of flap accuracy that each cause costs, as Markdown."""
    asked = [box for _, box in boxes if box["flaps_in_cloud"]]
    lost = {"the whole box was missed": 0.0, "a flap of a box that was found": 0.0, "a part told as a wrong flap": 0.0}
    for box in asked:
        gone = box["flaps_in_cloud"] - box["flaps_right"]
        cause = "the whole box was missed" if box["object"] is None else "a flap of a box that was found"
        lost[cause] += gone / box["flaps_in_cloud"]
        lost["a part told as a wrong flap"] += box["flaps_wrong"] / box["flaps_in_cloud"]
    rows = [f"| {cause} | {100 * points / len(asked):.1f} |" for cause, points in lost.items()]
    return ["| cause | points of flap accuracy |", "|---|---:|", *rows, ""]


def chosen(evaluation: dict[str, Any]) -> list[tuple[str, float]]:
    """The best frame, the middle one and the worst, by mean full accuracy; ties by name."""
    frames = [frame for frame in evaluation["frames"] if frame["boxes"]]
    ranked = sorted((float(np.mean([*map(full_share, frame["boxes"])])), str(frame["name"])) for frame in frames)
    picked = [ranked[-1], ranked[len(ranked) // 2], *ranked[:WORST]]
    return [(name, share) for share, name in picked]


def draw(axes: Axes, folder: Path, evaluation: dict[str, Any], name: str, share: float) -> None:
    """One frame: its image, what is told of it, and what was missed."""
    entry = next(entry for entry in list_set(folder) if entry.name == name)
    frame, cloud = read_entry(entry), read_cloud(entry.cloud_path)
    inferred = infer(cloud, method=evaluation["method"])
    view = view_of(cloud, inferred.perception)
    _, seen = seen_image(cloud, view)
    show(axes, faint(seen, cloud, view), f"{name}: full {100 * share:.0f} %")
    draw_objects(axes, view, inferred.model.objects)
    told = next(told for told in evaluation["frames"] if told["name"] == name)
    missed = {(box["box"], panel.replace("_", "")) for box in told["boxes"] for panel in box["missed"]}
    for part in frame.truth.parts:
        corners = np.array(part.corners)
        if (part.box, part.name) in missed and view.has_before_it(corners):
            axes.add_patch(Polygon(view.project(corners), closed=True, fill=False, edgecolor=MISSED, linewidth=1.4))


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("set", type=Path)
    parser.add_argument("evaluation", type=Path)
    parser.add_argument("-o", "--out", type=Path, required=True)
    options = parser.parse_args()
    evaluation = json.loads(options.evaluation.read_text())
    boxes = list(boxes_of(evaluation))
    lines = [
        "# What stands in the way",
        "",
        f"`python -m benchmarks.gallery {shlex.join(sys.argv[1:])}`",
        "",
        f"{len(boxes)} boxes, method {evaluation['method']}.",
        "",
        *by_panels(boxes),
        *table("boxes in the frame", boxes, lambda count, _: str(count)),
        *causes(boxes),
        "![The best frame, the middle one and the ten worst](gallery.png)",
        "",
        "The best frame, the middle one, and the ten worst; true panels that no right part holds are outlined in red.",
    ]
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out / "README.md").write_text("\n".join(lines) + "\n")
    picked = chosen(evaluation)
    figure = Figure(figsize=(4.2 * COLUMNS, 3.4 * -(-len(picked) // COLUMNS)), facecolor="white")
    grid = figure.subplots(-(-len(picked) // COLUMNS), COLUMNS).ravel()
    figure.subplots_adjust(left=0.005, right=0.995, top=0.96, bottom=0.01, wspace=0.03, hspace=0.14)
    for axes, (name, share) in zip(grid, picked, strict=False):
        draw(axes, options.set, evaluation, name, share)
    save_png(figure, options.out / "gallery.png")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
