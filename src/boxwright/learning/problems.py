"""Labelled frames as learning problems: candidate assignments and how correct each is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from boxwright import _core
from boxwright.evaluation.roles import from_truth_name
from boxwright.evaluation.verdicts import PANEL_READINGS
from boxwright.types import Truth

Assignments = NDArray[np.int64]
"""(K, parts): the problem's segment that plays each part, -1 for none."""


@dataclass(frozen=True, eq=False)
class LearningProblem:
    """The segments of one group of a labelled frame, and what each is worth in each role.

    A view reads the template's names as one true box under one symmetry of the template. `gains` (views, parts,
    segments + 1) is +1 where a segment is right for a part, -1 where wrong, 0 where neither; its last column is the
    empty part's 0, so that index -1 finds it. `panels` (views,) counts the box's panels in the cloud.
    """

    frame: str
    problem: _core.Problem
    gains: NDArray[np.float64]
    panels: NDArray[np.float64]
    truths: Assignments
    """For each box that shows here, the right segment for each part."""

    def correctness(self, assignments: Assignments) -> NDArray[np.float64]:
        """(right - wrong) / panels in the cloud, (K,), of each assignment under its best view (eq. 11)."""
        parts = np.arange(assignments.shape[1])
        totals = self.gains[:, parts[None, :], assignments].sum(axis=2)
        best: NDArray[np.float64] = (totals / self.panels[:, None]).max(axis=0)
        return best


def learning_problems(
    frame: str,
    perception: _core.Perception,
    template: _core.Template,
    truth: Truth,
    truth_labels: NDArray[np.uint16],
) -> list[LearningProblem]:
    """One problem for each group of segments in the frame."""
    shared = _shared_points(perception, truth, truth_labels)
    return [
        _learning_problem(frame, problem, shared[problem.scene_segments], perception, template, truth, truth_labels)
        for problem in _core.Problem.by_group(perception, template)
    ]


def no_box_gains(parts: int, segments: int) -> NDArray[np.float64]:
    """(1, parts, segments + 1) gains where no box shows: whatever is assigned is wrong."""
    gains = np.full((1, parts, segments + 1), -1.0)
    gains[:, :, -1] = 0.0
    return gains


def _shared_points(perception: _core.Perception, truth: Truth, truth_labels: NDArray[np.uint16]) -> NDArray[np.int64]:
    """(segments, true parts + 1): points of a segment with each true label, column 0 for "on no panel"."""
    labels = perception.labels
    mine = labels >= 0
    columns = len(truth.parts) + 1
    flat = labels[mine].astype(np.int64) * columns + truth_labels[mine]
    return np.bincount(flat, minlength=len(perception) * columns).reshape(len(perception), columns)


def _learning_problem(
    frame: str,
    problem: _core.Problem,
    shared: NDArray[np.int64],
    perception: _core.Perception,
    template: _core.Template,
    truth: Truth,
    truth_labels: NDArray[np.uint16],
) -> LearningProblem:
    readings = np.bincount(truth_labels, minlength=len(truth.parts) + 1)
    boxes = [box.index for box in truth.boxes]
    gains, panels, truths = [], [], []
    for box in boxes:
        roles = _roles(template, truth, box)
        worth = _worth(shared, readings, roles)
        in_cloud = sum(readings[column] >= PANEL_READINGS for column in roles if column)
        right = _right_segments(worth, shared, roles)
        if in_cloud and (right >= 0).any():
            truths.append(right)
            for symmetry in template.symmetries:
                gains.append(worth[symmetry])
                panels.append(in_cloud)
    if not gains:
        gains.extend(no_box_gains(len(template.parts), len(problem)))
        panels.append(len(template.parts))
    return LearningProblem(
        frame=frame,
        problem=problem,
        gains=np.array(gains),
        panels=np.array(panels, np.float64),
        truths=np.array(truths, np.int64).reshape(len(truths), len(template.parts)),
    )


def _roles(template: _core.Template, truth: Truth, box: int) -> list[int]:
    """For each part of the template the true label of that box's panel, 0 where the box has none."""
    label_of = {from_truth_name(part.name): k + 1 for k, part in enumerate(truth.parts) if part.box == box}
    return [label_of.get(name, 0) for name in template.parts]


def _worth(shared: NDArray[np.int64], readings: NDArray[np.int64], roles: list[int]) -> NDArray[np.float64]:
    """(parts, segments + 1): +1 right, -1 wrong, 0 neither, by docs/formats.md "The figures of merit"."""
    points = shared.sum(axis=1)
    worth = np.full((len(roles), len(shared) + 1), -1.0)
    worth[:, -1] = 0.0
    for part, label in enumerate(roles):
        if not label:
            continue
        lies_there = (points > 0) & (2 * shared[:, label] >= points)
        if readings[label] < PANEL_READINGS:
            worth[part, :-1][lies_there] = 0.0
        else:
            worth[part, :-1][lies_there & (2 * shared[:, label] >= readings[label])] = 1.0
    return worth


def _right_segments(worth: NDArray[np.float64], shared: NDArray[np.int64], roles: list[int]) -> NDArray[np.int64]:
    """For each part its right segment, -1 where perception found none."""
    right = np.full(len(roles), -1, np.int64)
    for part, label in enumerate(roles):
        candidates = np.flatnonzero(worth[part, :-1] > 0)
        if candidates.size:
            right[part] = candidates[np.argmax(shared[candidates, label])]
    return right
