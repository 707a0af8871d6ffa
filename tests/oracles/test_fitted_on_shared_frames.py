"""The default against the truth of labelled frames that another simulator made."""

from __future__ import annotations

from pathlib import Path

from boxwright.scoring import evaluate


def test_boxes_of_another_simulator_are_found_and_measured(shared_dir: Path) -> None:
    every = evaluate(shared_dir / "data" / "labelled").category("all")
    assert (every.frames, every.boxes, every.false_objects) == (14, 16, 0)
    assert every.flap_accuracy_percent is not None
    assert every.flap_accuracy_percent >= 94.0
    assert every.full_accuracy_percent is not None
    assert every.full_accuracy_percent >= 94.0
