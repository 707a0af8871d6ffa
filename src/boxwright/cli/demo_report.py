"""What `boxwright demo` prints."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.evaluation import BoxScore, FrameScore
    from boxwright.types import Model, Object, Truth


def print_comparison(truth: Truth, score: FrameScore, model: Model) -> None:
    """The true and the inferred angles of each box's flaps, and its dimensions."""
    out = console()
    out.print(f"A simulated Kinect frame of a {truth.category} box, understood in {model.seconds.total:.2f} s.\n")
    for box in score.boxes:
        found = None if box.object is None else model.objects[box.object]
        out.print(_flaps(truth, box, found))
        _print_dimensions(truth, box, found)
    out.print(_counts(score))


def _flaps(truth: Truth, box: BoxScore, found: Object | None) -> Table:
    """A row for each true flap: its angle, the angle of the part that plays it, and how that was judged."""
    from boxwright.evaluation.roles import from_truth_name

    made = table(f"box {box.box}", "flap", "true angle\ndeg", "inferred\ndeg", "difference\ndeg", "judged")
    made.columns[4].justify = "left"
    joint_of = {joint.child: joint for joint in found.joints} if found else {}
    verdict_of = {verdict.role: verdict for verdict in box.verdicts}
    for part in truth.parts:
        role = from_truth_name(part.name)
        if part.box != box.box or part.angle_deg is None:
            continue
        verdict = verdict_of.get(role)
        joint = joint_of.get(verdict.name) if verdict else None
        inferred_deg = None if joint is None else math.degrees(joint.position)
        difference_deg = None if inferred_deg is None else inferred_deg - part.angle_deg
        judged = verdict.verdict if verdict else "missed" if role in box.missed else "hardly visible"
        made.add_row(role, number(part.angle_deg), number(inferred_deg), number(difference_deg), judged)
    return made


def _print_dimensions(truth: Truth, box: BoxScore, found: Object | None) -> None:
    if found is None or found.dimensions is None or box.rotation is None:
        return
    true_dims = next(true.dims for true in truth.boxes if true.index == box.box)
    if true_dims is None:
        return
    length, width, height = found.dimensions
    if box.rotation % 2:
        length, width = width, length
    sizes = f"{_size((length, width, height))}, true {_size(true_dims)}"
    console().print(f"length x width x height: {sizes}; template {found.template}\n")


def _size(dims_m: tuple[float, float, float]) -> str:
    return " x ".join(f"{1000 * metres:.0f}" for metres in dims_m) + " mm"


def _counts(score: FrameScore) -> str:
    right = sum(box.panels_right for box in score.boxes)
    wrong = sum(box.panels_wrong for box in score.boxes)
    in_cloud = sum(box.panels_in_cloud for box in score.boxes)
    return f"Panels: {right} right and {wrong} wrong of {in_cloud} in the cloud; false objects: {score.false_objects}."


def print_files(folder: Path, name: str, files: tuple[Path, ...]) -> None:
    """Where everything is, and what to do next."""
    answer = folder / name
    lines = [
        "",
        f"The frame:  {folder / name}.pcd (.truth.json, .labels.npz)",
        f"The answer: {answer}/: {', '.join(path.name for path in files)}",
        "",
        "Next:",
        f"  look at {files[-1]}",
        f"  boxwright explain {answer}      why it scored so",
        "  boxwright infer YOUR.pcd -o out --figure      your own frame",
        "  boxwright synth set --count 20 && boxwright evaluate set      how good it is",
    ]
    console().print("\n".join(lines), soft_wrap=True)
