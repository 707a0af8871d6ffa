"""What `boxwright explain` prints."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from boxwright.cli.screen import console, number, table

if TYPE_CHECKING:
    from boxwright.runner_up import RunnerUp, Search, Segments
    from boxwright.types import Object

WHOLE = (
    "Each is judged by itself, as a whole box: the score is the log odds that it is one, the terms are their summands "
    "(docs/maths.md, eq. 90). None came second."
)
RECAST = (
    "its segments were found as another template's, and its shape tells this one; the other's terms, which made the "
    "score, are not kept"
)
LISTS = {"exact": "the exact search's list of all assignments", "staged": "the staged search's list"}


@dataclass(frozen=True)
class Reason:
    """Why an object: `segments` and `search` are known of an assignment that was found just now.

    A file does not tell them, and a whole box is no assignment.
    """

    found: Object
    segments: Segments | None = None
    search: Search | None = None
    second: RunnerUp | None = None


def print_json(reasons: list[Reason]) -> None:
    """All objects as one JSON list."""
    import msgspec

    print(msgspec.json.format(msgspec.json.encode([_as_json(reason) for reason in reasons]), indent=1).decode())


def _as_json(reason: Reason) -> dict[str, Any]:
    found, second = reason.found, reason.second
    told = {"template": found.template, "score": found.score, "score_terms": found.score_terms}
    if reason.segments is None:
        return told
    return told | {
        "segments": reason.segments,
        "search": reason.search,
        "runner_up": None
        if second is None
        else {
            "score": second.score,
            "segments": second.segments,
            "refused": second.refused,
            "differences": [
                {
                    "name": term.name,
                    "kind": term.kind,
                    "value": term.value,
                    "runner_up_value": term.runner_up_value,
                    "weight": term.weight,
                    "contribution": term.contribution,
                }
                for term in second.differences
            ],
        },
    }


def print_reasons(reasons: list[Reason], path: Path, planes: str | None) -> None:
    """Each object's terms, then what came second and why; `planes` is the front end of a cloud's segments.

    Of a model it is None.
    """
    from boxwright.runner_up import is_judged_whole

    out = console()
    if not reasons:
        out.print(f"{path}: no object", soft_wrap=True)
    for k, reason in enumerate(reasons):
        _print_terms(k, reason.found)
        if reason.segments is None or reason.search is None:
            continue
        if reason.second is None:
            out.print(f"No second of free segments in {LISTS[reason.search]}.\n")
        else:
            _print_second(reason.found, reason.segments, reason.second)
    if any(is_judged_whole(reason.found) for reason in reasons):
        out.print(WHOLE, soft_wrap=True)
    elif planes is None and any(reason.found.score_terms for reason in reasons):
        out.print("What came second is told of the cloud itself: boxwright explain CLOUD")
    if planes is not None and any(reason.segments is not None for reason in reasons):
        out.print(f"Segments are numbered as by: boxwright segment {path} --planes {planes}", soft_wrap=True)


def _print_terms(k: int, found: Object) -> None:
    if not found.score_terms:
        console().print(f"object {k}: {found.template}, score {found.score:.4f}: {RECAST}\n", soft_wrap=True)
        return
    made = table(
        f"object {k}: {found.template}, score {found.score:.4f}", "term", "kind", "value", "weight", "weight x value"
    )
    made.columns[1].justify = "left"
    for term in sorted(found.score_terms, key=lambda term: -abs(term.contribution)):
        made.add_row(term.name, term.kind, number(term.value, 4), number(term.weight, 4), number(term.contribution, 4))
    made.add_section()
    made.add_row("sum", "", "", "", number(sum(term.contribution for term in found.score_terms), 4))
    console().print(made)


def _print_second(found: Object, segments: Segments, second: RunnerUp) -> None:
    out = console()
    lead = found.score - second.score
    out.print(f"Second in {LISTS[second.search]}: score {second.score:.4f}, {lead:.4f} less.", soft_wrap=True)
    if second.refused:
        out.print(f"{second.refused} that score more lack parts that the template asks for.")
    made = table("where the two differ", "part", "here\nsegment", "second\nsegment")
    for part, segment in segments.items():
        if second.segments[part] != segment:
            made.add_row(part, _segment(segment), _segment(second.segments[part]))
    out.print(made)
    made = table(
        "what decided", "term", "kind", "value\nhere", "value of\nthe second", "weight", "weight x\ndifference"
    )
    made.columns[1].justify = "left"
    for term in second.differences:
        made.add_row(
            term.name,
            term.kind,
            number(term.value, 4),
            number(term.runner_up_value, 4),
            number(term.weight, 4),
            number(term.contribution, 4),
        )
    made.add_section()
    made.add_row("sum", "", "", "", "", number(sum(term.contribution for term in second.differences), 4))
    out.print(made)


def _segment(segment: int | None) -> str:
    return "none" if segment is None else str(segment)
