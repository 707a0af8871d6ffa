"""The scorer of benchmarks/front_end.py on label images made by hand."""

from __future__ import annotations

import numpy as np
import pytest
from planes.report import by_role, precision, recall
from planes.score import FrameScore, score_frame
from planes.truth import panels_paired

from boxwright.types import Camera, TrueBox, TrueFace, TruePart, Truth

CAMERA = Camera(500.0, 500.0, 50.0, 50.0, 100, 100)
CORNERS = ((0.0, 0.0, 1.0), (1.0, 0.0, 1.0), (1.0, 1.0, 1.0), (0.0, 1.0, 1.0))
LEAN_DEG = 90.0


def made_up(*panels: tuple[str, float | None], faces: int = 1) -> Truth:
    """One box of panels by name and angle, and faces that are no panels."""
    parts = [
        TruePart(0, name, f"side{name[-1]}" if name.startswith("flap") else None, False, angle, CORNERS, 0)
        for name, angle in panels
    ]
    others = (TrueFace((0.0, 0.0, -1.0), -1.0, 0),) * faces
    box = TrueBox(0, "small", "rsc", (1.0, 1.0, 1.0))
    return Truth("hand", "small", CAMERA, (0.0, 0.0, 1.0), (box,), tuple(parts), others)


def score(truth: Truth, *runs: tuple[int, int, int]) -> FrameScore:
    """Readings in runs of (face, segment, how many)."""
    face, segment, count = np.array(runs).T
    return score_frame(truth, np.repeat(face, count), np.repeat(segment, count))


def test_half_the_union_is_enough_and_less_is_not() -> None:
    truth = made_up(("base", None), ("side0", None))
    exact = score(truth, (1, 0, 1000), (1, -1, 1000), (2, 1, 999), (2, -1, 1000))
    assert [panel.found for panel in exact.apart] == [True, False]
    assert exact.apart[0].iou == 0.5
    spilt = score(truth, (1, 0, 1000), (0, 0, 1001))
    assert not spilt.apart[0].found, "readings of a segment count on no face too"
    assert spilt.apart[0].covered == 1.0


def test_panels_count_from_500_readings_on_and_are_small_below_2000() -> None:
    truth = made_up(("base", None), ("side0", None), ("side1", None), ("side2", None))
    frame = score(truth, (1, 0, 499), (2, 1, 500), (3, 2, 1999), (4, 3, 2000))
    assert [panel.name for panel in frame.apart] == ["0:side0", "0:side1", "0:side2"]
    assert [panel.small for panel in frame.apart] == [True, True, False]


@pytest.mark.parametrize(
    ("angle_deg", "is_pair"),
    [
        (90.0, True),
        (80.0, True),
        (79.9, False),
        (100.1, False),
        (265.0, True),
        (-85.0, True),
        (0.0, False),
        (180.0, False),
    ],
)
def test_a_flap_in_its_sides_plane_is_one_panel_with_it(angle_deg: float, is_pair: bool) -> None:
    planes = panels_paired(made_up(("base", None), ("side2", None), ("flap2", angle_deg)))
    roles = [plane.role for plane in planes]
    assert roles == (["base", "pair"] if is_pair else ["base", "side", "flap"])


def test_the_union_of_a_pair_is_found_by_one_segment_and_told_as_two_beside() -> None:
    truth = made_up(("side0", None), ("flap0", LEAN_DEG))
    merged = score(truth, (1, 0, 1500), (2, 0, 1000))
    assert [(panel.name, panel.role, panel.readings, panel.iou) for panel in merged.paired] == [
        ("0:side0+flap0", "pair", 2500, 1.0)
    ]
    assert [panel.found for panel in merged.apart] == [True, False]
    assert precision([merged], 500) == (1, 1)
    tiny = score(truth, (1, 0, 300), (2, 0, 300))
    assert len(tiny.paired) == 1, "the union counts from 500 readings on, though neither does alone"
    assert not tiny.apart


def test_precision_is_over_segments_and_any_true_plane() -> None:
    truth = made_up(("base", None), faces=1)
    frame = score(truth, (1, 0, 600), (2, 1, 5000), (0, 2, 700), (2, 3, 499), (1, -1, 100))
    assert precision([frame], 500) == (2, 3), "a panel and a floor, not what lies on no face; 499 readings do not count"
    assert precision([frame], 0) == (2, 4)
    thin = score(made_up(("base", None), ("side0", None)), (1, 0, 400), (0, 0, 300))
    assert precision([thin], 500) == (1, 1), "the true plane itself may have fewer than 500 readings"
    assert not thin.apart


def test_recall_by_role_adds_up() -> None:
    truth = made_up(("base", None), ("side0", None), ("flap0", 45.0), ("tuck0", 20.0))
    frame = score(truth, (1, 0, 3000), (2, -1, 2500), (3, 2, 700), (4, 3, 700))
    rows = by_role([frame, frame], paired=True)
    assert rows == {"base": (2, 2), "side": (0, 2), "flap": (2, 2), "tuck": (2, 2), "small": (4, 4), "all": (6, 8)}
    assert recall([frame], paired=False) == (3, 4)


def test_what_does_not_fit_is_refused() -> None:
    truth = made_up(("base", None), faces=0)
    with pytest.raises(ValueError, match="as many"):
        score_frame(truth, np.zeros(4, np.uint16), np.zeros(5, np.int32))
    with pytest.raises(ValueError, match="faces go to 2 of 1"):
        score(truth, (2, 0, 5))


def test_nothing_found_is_scored() -> None:
    frame = score(made_up(("base", None)), (1, -1, 900))
    assert [panel.iou for panel in frame.apart] == [0.0]
    assert precision([frame], 0) == (0, 0)
