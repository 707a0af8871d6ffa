"""segments.json and its labels: what is kept, what is refused."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest

from boxwright.io.segments import load_segments, read_segment_labels, save_segments, write_segment_labels
from boxwright.types import Segment, Segmentation

SEGMENT: dict[str, Any] = {
    "normal": [0.0, 0.0, 1.0],
    "distance": 0.5,
    "rms": 0.002,
    "points": 700,
    "rectangle": [[0.0, 0.0, 0.5], [0.4, 0.0, 0.5], [0.4, 0.2, 0.5], [0.0, 0.2, 0.5]],
    "edges": ["edge", "crease", "occluded", "border"],
    "hull": [[0.0, 0.0, 0.5], [0.4, 0.0, 0.5], [0.0, 0.2, 0.5]],
    "group": -1,
}
CONTENT: dict[str, Any] = {
    "format": "boxwright.segments",
    "version": 1,
    "source": {"file": "frame.pcd", "points": 1000, "organized": True},
    "warnings": [],
    "seconds": {"read": 0.01, "stages": {"planes": 0.02}, "total": 0.02},
    "up": [0.0, 0.0, 1.0],
    "support_plane": None,
    "segments": [SEGMENT],
}


def test_files_come_back_as_they_were(tmp_path: Path) -> None:
    segmentation = msgspec.convert(CONTENT, type=Segmentation)
    save_segments(segmentation, tmp_path / "segments.json")
    assert load_segments(tmp_path / "segments.json") == segmentation
    labels = np.array([-1, 0, 40_000, 0], np.int32)
    write_segment_labels(labels, tmp_path / "labels.npz")
    assert np.array_equal(read_segment_labels(tmp_path / "labels.npz"), labels)


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"normal": [0.0, 0.0, 2.0]}, "unit"),
        ({"rms": -1.0}, "rms"),
        ({"edges": ["edge", "edge", "edge", "end"]}, "edges"),
        ({"rectangle": SEGMENT["rectangle"][:3]}, "rectangle"),
        ({"hull": SEGMENT["hull"][:2]}, "hull"),
        ({"group": -2}, "group"),
    ],
)
def test_what_does_not_fit_is_refused(change: dict[str, Any], word: str) -> None:
    with pytest.raises(msgspec.ValidationError, match=word):
        msgspec.convert(SEGMENT | change, type=Segment)
