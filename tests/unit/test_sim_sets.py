"""Scene sets on disk."""

from pathlib import Path

import numpy as np

from boxwright.io.truth import load_truth, read_truth_faces, read_truth_labels
from boxwright.simulation import make_frame, write_set


def test_a_set_can_be_made_longer_and_read_back(tmp_path: Path) -> None:
    whole, parts = tmp_path / "whole", tmp_path / "parts"
    names = write_set(whole, 3, 4, ("small", "pizza"))
    assert names == ["small_0000", "pizza_0001", "small_0002"]
    assert write_set(parts, 1, 4, ("small", "pizza")) + write_set(parts, 2, 4, ("small", "pizza"), start=1) == names
    files = sorted(path.name for path in whole.iterdir())
    assert len(files) == 9
    for name in files:
        assert (whole / name).read_bytes() == (parts / name).read_bytes(), name
    frame = make_frame("pizza", 4, 1)
    assert load_truth(whole / "pizza_0001.truth.json") == frame.truth
    assert np.array_equal(read_truth_labels(whole / "pizza_0001.labels.npz"), frame.labels)
    assert np.array_equal(read_truth_faces(whole / "pizza_0001.labels.npz"), frame.faces)
