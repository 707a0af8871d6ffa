"""What full model accuracy is lost to: each lost point of scene sets laid to one cause (the rules: lost_points.py).

    python benchmarks/error_causes.py SET... [--jobs N] [--json OUT]

SET is a folder of NAME.pcd, NAME.truth.json, NAME.labels.npz. Each is inferred by the default method. "accuracy %" is
what a cause takes from full accuracy, averaged over boxes: with the accuracy itself these sum to 100.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter
from pathlib import Path
from typing import Any

from lost_points import CAUSES, Judged, judge
from rich.console import Console
from rich.table import Table

from boxwright.evaluation import list_set
from boxwright.parallel import ordered_map, processors
from boxwright.pipeline import DEFAULT_METHOD, METHODS

KINDS = ("base", "side", "flap")
MISSED = "of boxes missed altogether"
EXAMPLES = 3
LARGEST = 3
PRINTED_WIDTH = 200
"""Columns where the table does not go to a terminal."""


def tally(judged: list[Judged]) -> dict[str, Any]:
    """All figures, as --json writes them."""
    boxes = [box for frame in judged for box in frame.score.boxes]
    losses = [(loss, frame.score.name) for frame in judged for loss in frame.losses]
    rated = sum(box.panels_in_cloud > 0 for box in boxes)
    causes = {}
    for cause in CAUSES:
        mine = [(loss, name) for loss, name in losses if loss.cause == cause]
        causes[cause] = {
            "count": len(mine),
            "share_percent": 100 * len(mine) / max(len(losses), 1),
            "full_accuracy_percent": 100 * sum(loss.accuracy for loss, _ in mine) / max(rated, 1),
            "kinds": {kind: sum(loss.kind == kind for loss, _ in mine) for kind in KINDS},
            "examples": list(dict.fromkeys(name for _, name in mine))[:EXAMPLES],
        }
    return {
        "frames": len(judged),
        "frames_refused": sum(frame.refused for frame in judged),
        "boxes": len(boxes),
        "boxes_missed": sum(box.object is None for box in boxes),
        "false_objects": sum(frame.score.false_objects for frame in judged),
        "panels_in_cloud": sum(box.panels_in_cloud for box in boxes),
        "right": sum(box.panels_right for box in boxes),
        "wrong": sum(box.panels_wrong for box in boxes),
        "lost": len(losses),
        "causes": causes,
        "found_by_perception": found_by_perception(judged),
    }


def found_by_perception(judged: list[Judged]) -> dict[str, dict[str, int]]:
    """The true panels in the cloud that a segment finds, by kind and in all."""
    panels = [panel for frame in judged for panel in frame.panels]
    there = Counter(panel.kind for panel in panels) + Counter(all=len(panels))
    there += Counter({MISSED: sum(panel.box_missed for panel in panels)})
    hits = [panel for panel in panels if panel.found]
    found = Counter(panel.kind for panel in hits) + Counter(all=len(hits))
    found += Counter({MISSED: sum(panel.box_missed for panel in hits)})
    return {key: {"found": found[key], "there": there[key]} for key in (*KINDS, "all", MISSED)}


def report(figures: dict[str, Any]) -> None:
    """Prints the table and what it says."""
    table = Table(title=f"{figures['lost']} points of full accuracy lost: where to")
    table.add_column("cause")
    for heading in ("count", "share %", "accuracy %", *KINDS):
        table.add_column(heading, justify="right")
    table.add_column("for example")
    for cause, row in figures["causes"].items():
        shares = (f"{row['share_percent']:.1f}", f"{row['full_accuracy_percent']:.1f}")
        table.add_row(cause, str(row["count"]), *shares, *map(str, row["kinds"].values()), ", ".join(row["examples"]))
    console = Console()
    (console if console.is_terminal else Console(width=PRINTED_WIDTH)).print(table)
    print(
        f"{figures['frames']} frames, {figures['frames_refused']} of them refused; {figures['boxes']} boxes, "
        f"{figures['boxes_missed']} of them missed; panels in the cloud: {figures['panels_in_cloud']}; "
        f"right: {figures['right']}; wrong parts: {figures['wrong']}; "
        f"false objects, which cost no point here: {figures['false_objects']}"
    )
    print("True panels that perception finds (the paper: almost 100 %):")
    for kind, row in figures["found_by_perception"].items():
        print(f"  {kind}: {row['found']} of {row['there']} ({100 * row['found'] / max(row['there'], 1):.1f} %)")
    print("The largest causes:")
    largest = sorted(figures["causes"].items(), key=lambda item: -item[1]["count"])[:LARGEST]
    for place, (cause, row) in enumerate(largest, 1):
        print(f"  {place}. {cause}: {row['count']} of {figures['lost']} lost points ({row['share_percent']:.1f} %)")


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path)
    parser.add_argument("--method", default=DEFAULT_METHOD, choices=METHODS)
    parser.add_argument("--jobs", type=int, default=processors())
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    entries = [entry for folder in options.sets for entry in list_set(folder)]
    figures = tally(list(ordered_map(lambda entry: judge(entry, options.method), entries, options.jobs)))
    report(figures)
    if options.json:
        options.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main()
