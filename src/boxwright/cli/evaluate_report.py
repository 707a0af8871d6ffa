"""What `boxwright evaluate` prints: the paper's table with ours beside it, and the errors of hinges and dimensions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.evaluation import Spread, Summary


@dataclass(frozen=True)
class PaperFigures:
    """A row of the paper's table of results, per cent, on its own frames of a real Kinect."""

    flap_accuracy_percent: float
    full_accuracy_percent: float


PAPER = {
    "small": PaperFigures(82.50, 79.64),
    "medium": PaperFigures(88.54, 76.00),
    "large": PaperFigures(90.00, 78.04),
    "carton": PaperFigures(87.50, 66.96),
    "cake": PaperFigures(85.00, 70.50),
    "pizza": PaperFigures(85.41, 73.06),
    "all": PaperFigures(86.74, 76.55),
}


def print_summary(summary: Summary, method: str, set_name: str, frames: int, refused: int) -> None:
    """Both tables, and how many frames they rest on."""
    out = console()
    out.print(_accuracies(summary, f"{set_name}, method {method}"))
    out.print(_errors(summary))
    refusals = f", {refused} of them refused" if refused else ""
    out.print(f"{frames} frames{refusals}. Accuracy: (right - wrong) / in the cloud, averaged over boxes.")
    out.print("Usable: of all flaps in the cloud, those within 3 deg and 10 mm of the hinge and 5 deg of the angle.")
    out.print("Paper: figures of 2011 on its own real frames. Tucks: flaps on flaps, found / in the cloud.")


def _accuracies(summary: Summary, title: str) -> Table:
    made = table(
        title, "category", "frames", "boxes", "boxes\nmissed", "false\nobjects", "flap\n%", "paper\n%", "full\n%",
        "paper\n%", "usable\nflaps %", "tucks",
    )  # fmt: skip
    for row in summary.categories:
        paper = PAPER.get(row.category)
        made.add_row(
            row.category,
            str(row.frames),
            str(row.boxes),
            str(row.boxes_without_object),
            str(row.false_objects),
            number(row.flap_accuracy_percent),
            number(paper.flap_accuracy_percent if paper else None),
            number(row.full_accuracy_percent),
            number(paper.full_accuracy_percent if paper else None),
            number(row.usable_flaps_percent),
            f"{row.tucks_found}/{row.tucks_in_cloud}" if row.tucks_in_cloud else "-",
        )
    return made


def _errors(summary: Summary) -> Table:
    made = table(
        "errors of right flaps and of dimensions: median / 90th percentile",
        "category", "flaps\nright", "flaps\nwrong", "in the\ncloud", "hinge axis\ndeg", "hinge distance\nmm",
        "flap angle\ndeg", "dimensions\nmm",
    )  # fmt: skip
    for row in summary.categories:
        made.add_row(
            row.category,
            str(row.flaps_right),
            str(row.flaps_wrong),
            str(row.flaps_in_cloud),
            _spread(row.hinge_angle_deg),
            _spread(row.hinge_distance_mm),
            _spread(row.flap_angle_deg),
            _spread(row.dimension_mm),
        )
    return made


def _spread(spread: Spread) -> str:
    return f"{number(spread.median)} / {number(spread.p90)}" if spread.count else "-"
