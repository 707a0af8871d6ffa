"""What a box that leans stands on: nobody sees it, and no way of the arm leads through it."""

from __future__ import annotations

from pathlib import Path

import msgspec
import numpy as np
from closing.problems import draw_problem

from boxwright.io.clouds import read_cloud
from boxwright.kinematics.transforms import from_pose
from boxwright.pipeline import infer
from boxwright.planning import measured_box, place_robot, plan_closing
from boxwright.simulation.physics import simulate
from boxwright.types import SupportPlane

ROBOT = "viper_s850"
ON_SOMETHING = "what it stands on"
LEANING = "large_000.pcd"
"""A labelled frame of a box that leans by 12 degrees; its flaps hang beside it."""


def test_between_a_base_that_leans_and_the_support_there_is_no_way() -> None:
    model = draw_problem(0).model
    fixed = measured_box(model, 0, np.eye(4))["fixed"]
    assert not [board for board in fixed if board["name"] == ON_SOMETHING]
    corners = np.array(next(board["corners"] for board in fixed if board["name"] == "base"))
    lean_rad = np.radians(10.0)
    along = (corners[1] - corners[0]) / np.linalg.norm(corners[1] - corners[0])
    normal = np.cos(lean_rad) * np.array([0.0, 0.0, 1.0]) + np.sin(lean_rad) * np.cross([0.0, 0.0, 1.0], along)
    distance = float((corners @ normal).min())
    plane = SupportPlane(normal=(normal[0], normal[1], normal[2]), distance=distance)
    leaning = measured_box(msgspec.structs.replace(model, support_plane=plane), 0, np.eye(4))["fixed"]
    under = [np.array(board["corners"]) for board in leaning if board["name"] == ON_SOMETHING]
    assert len(under) == 4
    for k, board in enumerate(under):
        np.testing.assert_allclose(board[:2], corners[[k, (k + 1) % 4]])
        above_m = board @ normal - distance
        assert (above_m[2:] < 1e-9).all()
        np.testing.assert_allclose(np.cross(board[3] - board[0], normal), 0.0, atol=1e-12)
    assert len(leaning) == len(fixed) + 4


def test_flaps_of_a_box_that_leans_are_closed_past_what_it_stands_on(shared_dir: Path) -> None:
    model = infer(read_cloud(shared_dir / "data" / "labelled" / LEANING)).model
    base_from_input = from_pose(place_robot(model, ROBOT))
    boards = measured_box(model, 0, base_from_input)["fixed"]
    assert [board["name"] for board in boards].count(ON_SOMETHING) == 4
    plan = plan_closing(model, ROBOT, base_from_input)
    run = simulate(plan, model).simulation
    assert run.stopped is None
    assert not run.unwanted
    assert len(plan.order) == 3
    assert all(run.flaps[name].held for name in plan.order)
