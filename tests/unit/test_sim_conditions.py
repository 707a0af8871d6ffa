"""Conditions: one thing is set, the rest of the scene stays."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.simulation import CATEGORIES, Conditions, Frame, make_frame
from boxwright.types import Truth


def _frame(**conditions: float | str | int) -> Frame:
    return make_frame("medium", 41, 2, boxes=1, conditions=Conditions(**conditions))  # type: ignore[arg-type]


def _middle(truth: Truth) -> np.ndarray:
    return np.mean([part.corners for part in truth.parts], axis=(0, 1))


def test_nothing_set_is_the_frame_as_drawn() -> None:
    drawn = make_frame("medium", 41, 2, boxes=1)
    assert np.array_equal(_frame().points, drawn.points, equal_nan=True)


def test_the_view_is_the_one_that_is_set_and_the_box_stays() -> None:
    drawn = make_frame("medium", 41, 2, boxes=1).truth
    for elevation_deg in (25.0, 50.0, 90.0):
        truth = _frame(elevation_deg=elevation_deg, distance_m=1.4).truth
        middle = _middle(truth)
        seen_deg = np.degrees(np.arcsin(-(middle @ truth.up) / np.linalg.norm(middle)))
        assert seen_deg == pytest.approx(elevation_deg, abs=6.0)
        assert np.linalg.norm(middle) == pytest.approx(1.4, abs=0.15)
        assert truth.boxes == drawn.boxes


def test_more_noise_is_more_depth_noise_at_the_same_pixels() -> None:
    calm, loud = _frame(things=0, noise=0.0).points[:, 2], _frame(things=0, noise=8.0).points[:, 2]
    both = np.isfinite(calm) & np.isfinite(loud)
    assert both.sum() > 100_000
    assert np.median(np.abs(loud - calm)[both]) > 0.003


def test_fewer_things_are_the_first_of_more() -> None:
    faces = [len(_frame(things=count).truth.faces) for count in (0, 3, 12)]
    assert faces == sorted(faces)
    assert faces[0] < faces[-1]


def test_the_kind_is_the_one_that_is_named() -> None:
    kinds = {make_frame(c, 1, 0, conditions=Conditions(variant="rsc")).truth.boxes[0].variant for c in CATEGORIES[:3]}
    assert kinds == {"rsc"}


@pytest.mark.parametrize(
    ("conditions", "named"),
    [
        (Conditions(variant="pizza"), "variant"),
        (Conditions(things=-1), "things"),
        (Conditions(elevation_deg=0.0), "elevation_deg"),
        (Conditions(distance_m=9.0), "distance_m"),
        (Conditions(noise=float("nan")), "noise"),
    ],
)
def test_what_cannot_be_is_refused_by_name(conditions: Conditions, named: str) -> None:
    with pytest.raises(ValueError, match=f"^{named} is "):
        make_frame("medium", 1, conditions=conditions)
