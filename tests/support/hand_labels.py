"""What a careful person would type for the segments of a simulated frame, taken from its truth."""

from __future__ import annotations

from collections.abc import Container
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation.roles import from_truth_name
from boxwright.io.segments import read_segment_labels
from boxwright.io.truth import load_truth, read_truth_labels
from boxwright.types import Truth


def roles_from_truth(
    truth: Truth, truth_labels: NDArray[np.uint16], segment_of: NDArray[np.int32], parts: Container[str]
) -> dict[int, str]:
    """A role among `parts` for each segment of which at least half lies on that panel; several boxes are a, b, c."""
    roles = {}
    for segment in range(int(segment_of.max()) + 1):
        counts = np.bincount(truth_labels[segment_of == segment], minlength=len(truth.parts) + 1)
        label = int(np.argmax(counts[1:])) + 1 if truth.parts else 0
        if label and 2 * counts[label] >= counts.sum():
            part = from_truth_name(truth.parts[label - 1].name)
            box = "abc"[truth.parts[label - 1].box] + "." if len(truth.boxes) > 1 else ""
            if part in parts:
                roles[segment] = box + part
    return roles


def fill_forms(truths: Path, labelled: Path, parts: Container[str]) -> int:
    """Types the roles into all forms of a set, from the truths of the same names; how many roles were typed."""
    typed = 0
    for form in sorted(labelled.glob("forms/*/*.roles.toml")):
        name = form.parent.name
        truth, labels = load_truth(truths / f"{name}.truth.json"), read_truth_labels(truths / f"{name}.labels.npz")
        roles = roles_from_truth(truth, labels, read_segment_labels(form.parent / "labels.npz"), parts)
        head, mark, table = form.read_text(encoding="utf-8").partition("[roles]\n")
        lines = table.splitlines()
        for segment, role in roles.items():
            lines[segment] = lines[segment].replace('""', f'"{role}"', 1)
        form.write_text(head + mark + "\n".join(lines) + "\n", encoding="utf-8")
        typed += len(roles)
    return typed
