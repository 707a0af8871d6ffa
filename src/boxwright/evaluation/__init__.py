"""Figures of merit against the truth of labelled frames (docs/formats.md)."""

from boxwright.evaluation.frames import score_frame
from boxwright.evaluation.report import (
    Answer,
    Evaluation,
    load_evaluation,
    make_evaluation,
    save_evaluation,
    score_answer,
    score_set,
)
from boxwright.evaluation.scores import BoxScore, FlapError, FrameScore, PartVerdict
from boxwright.evaluation.sets import LabelledFrame, SetEntry, list_set, read_entry, read_set
from boxwright.evaluation.summary import CategorySummary, Spread, Summary, summarize

__all__ = [
    "Answer",
    "BoxScore",
    "CategorySummary",
    "Evaluation",
    "FlapError",
    "FrameScore",
    "LabelledFrame",
    "PartVerdict",
    "SetEntry",
    "Spread",
    "Summary",
    "list_set",
    "load_evaluation",
    "make_evaluation",
    "read_entry",
    "read_set",
    "save_evaluation",
    "score_answer",
    "score_frame",
    "score_set",
    "summarize",
]
