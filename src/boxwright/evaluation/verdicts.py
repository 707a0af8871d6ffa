"""Which observed parts of an object are right, under each rotation of its names and under the best."""

from __future__ import annotations

import msgspec
import numpy as np

from boxwright.evaluation.overlap import Counts
from boxwright.evaluation.roles import FLAP, ROTATIONS, TUCK, from_truth_name, kind_of, rotated
from boxwright.evaluation.scores import PartVerdict, Verdict
from boxwright.types import Object, Truth

PANEL_READINGS = 400
"""A true panel with fewer readings does not count as in the cloud (docs/formats.md, "The figures of merit")."""


class Rotated(msgspec.Struct, frozen=True, kw_only=True):
    """An object's names read under one rotation: the verdict on each observed part."""

    rotation: int
    verdicts: tuple[PartVerdict, ...]

    def count(self, verdict: Verdict, kind: str) -> int:
        """How many parts of this kind have that verdict."""
        return sum(v.verdict == verdict and kind_of(v.name) == kind for v in self.verdicts)

    def count_panels(self, verdict: Verdict) -> int:
        """How many parts have that verdict, flaps on flaps apart. A part of a foreign kind counts: it is wrong here."""
        return sum(v.verdict == verdict and kind_of(v.name) != TUCK for v in self.verdicts)

    def merit(self) -> tuple[int, int, int]:
        """What the best rotation has most of: right less wrong panels, then flaps, then points on their roles."""
        return (
            self.count_panels("right") - self.count_panels("wrong"),
            self.count("right", FLAP) - self.count("wrong", FLAP),
            sum(v.points_on_role for v in self.verdicts),
        )


def true_panels(truth: Truth, box: int) -> dict[str, int]:
    """The true panels of a box, by their names as predicted ones are written: the index into `truth.parts`."""
    return {from_truth_name(part.name): i for i, part in enumerate(truth.parts) if part.box == box}


def judge(model_object: Object, part_on_true: Counts, readings: Counts, truth: Truth, box: int) -> tuple[Rotated, ...]:
    """The object judged against a box under each of the four rotations; counts are those of `Overlap`."""
    panels = true_panels(truth, box)
    return tuple(
        Rotated(
            rotation=rotation,
            verdicts=tuple(
                _judge_part(part.name, rotated(part.name, rotation), part_on_true[j], readings, truth, panels)
                for j, part in enumerate(model_object.parts)
                if part.observed
            ),
        )
        for rotation in ROTATIONS
    )


def _judge_part(
    name: str, role: str, on_true: Counts, readings: Counts, truth: Truth, panels: dict[str, int]
) -> PartVerdict:
    points = int(on_true.sum())
    on_role = int(on_true[panels[role]]) if role in panels else 0
    role_readings = int(readings[panels[role]]) if role in panels else 0
    most = int(np.argmax(on_true))
    on_panel = points > 0 and most < len(truth.parts)
    return PartVerdict(
        name=name,
        role=role,
        verdict=_verdict(points, on_role, role_readings),
        points=points,
        points_on_role=on_role,
        mostly_on=from_truth_name(truth.parts[most].name) if on_panel else None,
    )


def _verdict(points: int, on_role: int, role_readings: int) -> Verdict:
    """A part of `points`, of which `on_role` lie on the true panel of its role, which has `role_readings`."""
    if points == 0 or 2 * on_role < points:
        return "wrong"
    if role_readings < PANEL_READINGS:
        return "neither"
    return "right" if 2 * on_role >= role_readings else "wrong"
