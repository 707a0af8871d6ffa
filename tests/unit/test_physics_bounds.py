"""What physics is not asked: masses and steps beyond all sense; and what it says where a state is no longer finite."""

from __future__ import annotations

from pathlib import Path

import msgspec
import mujoco
import numpy as np
import pytest

from boxwright.simulation.physics import Load, PhysicsSettings, Session, crease_class, staged_plan, true_box
from boxwright.simulation.physics.quiet import heard_warnings
from boxwright.types import Plan
from support.finger import Finger, push_shut
from support.true_boxes import carton, truth_of
from support.true_models import model_of


@pytest.mark.parametrize("mass_kg", [float("inf"), float("nan"), -float("inf"), -1.0, 0.0, 1000.1, 1e30])
def test_a_mass_is_finite_above_0_and_1000_kg_at_most(mass_kg: float) -> None:
    with pytest.raises(ValueError, match="mass_kg"):
        Load(mass_kg=mass_kg)
    assert Load(mass_kg=1000.0).mass_kg == 1000.0


@pytest.mark.parametrize("time_step_s", [1e-7, 4.9e-5, 0.0011, float("nan"), float("inf")])
def test_a_time_step_is_neither_long_nor_next_to_none(time_step_s: float) -> None:
    with pytest.raises(ValueError, match="time_step_s"):
        PhysicsSettings(time_step_s=time_step_s)
    assert PhysicsSettings(time_step_s=0.05 / 1000.0).time_step_s == 0.00005


@pytest.mark.parametrize("value", [np.nan, np.inf, 1e12])
def test_a_state_that_is_not_finite_ends_the_run_and_proves_nothing(
    value: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    box = true_box(truth_of(carton()), 0, np.eye(4))
    segments = push_shut(box, "flap_1", -8.0)
    start = np.array(segments[0].positions[0])
    session = Session(box, Finger(), start, crease_class("ordinary"), load=Load(mass_kg=4.0))
    session.follow(segments[:1])
    began_s = session.stage.time_s
    session.stage.data.qvel[-1] = value
    session.follow(segments[1:])
    told = session.verdict("ordinary", "true")
    assert told.failure is not None
    assert "physics came apart" in told.failure
    assert session.ended == told.failure
    assert told.simulated_s == pytest.approx(began_s), "it ends where it came apart"
    assert told.flaps["flap_1"].end_rad == pytest.approx(np.radians(95.0), abs=0.1), "as it stood before"
    assert not any(flap.closed or flap.held for flap in told.flaps.values())
    session.follow(segments)
    assert session.verdict("ordinary", "true").simulated_s == told.simulated_s
    assert not list(tmp_path.iterdir()), "no log of MuJoCo's"
    assert capfd.readouterr() == ("", "")


def test_whoever_heard_mujoco_s_warnings_hears_them_again() -> None:
    mine: list[str] = []
    mujoco.set_mju_user_warning(mine.append)
    try:
        with heard_warnings() as said:
            assert mujoco.get_mju_user_warning() is not None
            _blow_up()
        assert len(said) == 1
        assert not mine
        _blow_up()
        assert len(mine) == 1
    finally:
        mujoco.set_mju_user_warning(None)


def _blow_up() -> None:
    text = '<mujoco><worldbody><body><freejoint/><geom size=".1"/></body></worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qvel[0] = np.nan
    mujoco.mj_step(model, data)


@pytest.mark.parametrize("thickness_m", [0.0501, float("inf"), float("nan"), 0.0, -0.004])
def test_board_is_no_thicker_than_board_can_be(thickness_m: float) -> None:
    truth = truth_of(carton())
    plan = Plan(
        format="boxwright.plan",
        version=1,
        robot="viper_s850",
        base_from_input=tuple(map(tuple, np.eye(4).tolist())),  # type: ignore[arg-type]
        joint_names=(),
        order=(),
        flaps={},
        segments=(),
        method="none",
    )
    with pytest.raises(ValueError, match="thick"):
        staged_plan(plan, model_of(truth), truth, thickness_m=thickness_m)


def test_a_panel_without_room_for_its_board_is_told_by_its_size() -> None:
    thick = msgspec.structs.replace(true_box(truth_of(carton()), 0, np.eye(4)), thickness_m=0.4)
    with pytest.raises(ValueError, match=r"^a panel of 300 x \d+ mm leaves no room for board 400 mm thick$"):
        Session(thick, Finger(), np.zeros(3), crease_class("ordinary"))
