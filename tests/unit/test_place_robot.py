"""Where the arm is put: places from which boxes can be closed, found without trying them all."""

from __future__ import annotations

import numpy as np
import pytest
from closing.problems import draw_problem

from boxwright.planning import place_robot, placement, plan_closing

ROBOT = "viper_s850"
WHOLE = (1, 7, 9)
"""Problems whose flaps can all be closed from some place."""
LIGHT = 12
"""A light box: statics let two of its flaps be closed, wherever the arm stands."""


def test_a_place_closes_all_flaps_where_one_does() -> None:
    closed = 0
    for number in WHOLE:
        model = draw_problem(number).model
        place = place_robot(model, ROBOT)
        assert place == place_robot(model, ROBOT)
        plan = plan_closing(model, ROBOT, place)
        assert all(flap.status in ("planned", "already_closed", "absent") for flap in plan.flaps.values()), number
        closed += len(plan.order)
    assert closed >= 10


def test_a_box_that_no_place_closes_does_not_take_all_places(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[bool] = []
    ask = placement.ask

    def counted(*told: object, **options: object) -> object:
        asked.append(bool(options["quick"]))
        return ask(*told, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(placement, "ask", counted)
    model = draw_problem(LIGHT).model
    place_robot(model, ROBOT, settings={"assumed": {"mass_kg": 0.05}})
    assert np.count_nonzero(asked) <= 3 * placement.PATIENCE
    assert len(asked) - np.count_nonzero(asked) <= placement.LOOKED_AT_AGAIN
