"""What `boxwright segment` prints."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from boxwright.cli.outcome_report import head_of, print_files, print_problems, print_stages, print_summaries
from boxwright.cli.screen import console, number, table
from boxwright.segmentation import size_m, tilt_deg

if TYPE_CHECKING:
    from rich.table import Table

    from boxwright.cli.outcome import Outcome
    from boxwright.types import Segmentation


def print_outcome(outcome: Outcome[Segmentation], verbose: bool, as_json: bool) -> None:
    """One input: its error and warnings on standard error, its segments on standard output unless JSON is wanted."""
    found = outcome.answer
    print_problems(outcome, () if found is None else found.warnings)
    if found is None or as_json:
        return
    out = console()
    head = head_of(outcome.cloud, len(found.segments), "segment", found.seconds)
    out.print(segment_table(head, found) if found.segments else f"[bold]{head}[/]\n")
    if verbose:
        print_stages(found.seconds)
    print_files(outcome.files)


def print_json(outcomes: list[Outcome[Segmentation]]) -> None:
    """All inputs as one JSON list: what was found in which files, or the error."""
    print_summaries(outcomes, _as_json)


def _as_json(found: Segmentation) -> dict[str, Any]:
    groups = {segment.group for segment in found.segments if segment.group >= 0}
    return {
        "warnings": list(found.warnings),
        "seconds": found.seconds.total,
        "segments": len(found.segments),
        "groups": len(groups),
    }


def segment_table(title: str, found: Segmentation) -> Table:
    """A line for each segment: what it belongs to, size, how it leans, how flat it is, what ends its sides."""
    made = table(title, "segment", "group", "size\nmm", "tilt\ndeg", "rms\nmm", "readings", "sides")
    made.columns[6].justify = "left"
    for k, segment in enumerate(found.segments):
        group = "background" if segment.group < 0 else str(segment.group)
        made.add_row(
            str(k),
            group,
            " x ".join(f"{1000 * side:.0f}" for side in size_m(segment)),
            number(tilt_deg(segment, found.up)),
            number(1000 * segment.rms),
            str(segment.points),
            " ".join(segment.edges),
        )
    return made
