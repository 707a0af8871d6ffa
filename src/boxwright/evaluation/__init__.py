"""Figures of merit against the truth of labelled frames (docs/formats.md)."""

from boxwright.evaluation.frames import score_frame
from boxwright.evaluation.scores import BoxScore, FlapError, FrameScore, PartVerdict
from boxwright.evaluation.sets import LabelledFrame, SetEntry, list_set, read_entry, read_set
from boxwright.evaluation.summary import CategorySummary, Spread, Summary, summarize

__all__ = [
    "BoxScore",
    "CategorySummary",
    "FlapError",
    "FrameScore",
    "LabelledFrame",
    "PartVerdict",
    "SetEntry",
    "Spread",
    "Summary",
    "list_set",
    "read_entry",
    "read_set",
    "score_frame",
    "summarize",
]
