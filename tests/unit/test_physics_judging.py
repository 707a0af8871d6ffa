"""When a flap counts as closed: flaps and flaps on flaps set to angles by hand."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
import pytest

from boxwright.simulation.boxes import OpenBox, Tuck
from boxwright.simulation.physics import BoardBox, PhysicsSettings, crease_class, true_box
from boxwright.simulation.physics.judging import closed_boards
from boxwright.simulation.physics.stage import Stage
from boxwright.simulation.physics.world import build_world
from boxwright.types import FlapVerdict, Simulation
from support.true_boxes import carton, truth_of


def closed_at(box: BoardBox, **angles_deg: float) -> set[str]:
    """What is closed with flaps at these angles, the others standing."""
    stage = Stage(build_world(box, crease_class("ordinary"), PhysicsSettings()), box)
    for name, angle_deg in angles_deg.items():
        joint = stage.world.model.joint(stage.world.box.joint_of[name])
        stage.data.qpos[joint.qposadr[0]] = np.radians(angle_deg)
    mujoco.mj_forward(stage.world.model, stage.data)
    return closed_boards(stage.world, stage.data, box)


def test_within_fifteen_degrees_either_way_is_closed() -> None:
    box = true_box(truth_of(carton()), 0, np.eye(4))
    for angle_deg, closed in ((0.0, True), (14.9, True), (15.1, False), (-14.9, True), (-15.1, False), (90.0, False)):
        assert closed_at(box, flap_1=angle_deg) == ({"flap_1"} if closed else set())


def test_lying_on_a_closed_flap_is_closed_up_to_thirty_degrees() -> None:
    """Opposite flaps that overlap: the second lies on the first's back where their sheets touch."""
    flaps = tuple(flap and msgspec.structs.replace(flap, length_m=0.15) for flap in carton().flaps)
    box = true_box(truth_of(msgspec.structs.replace(carton(), flaps=flaps)), 0, np.eye(4))
    lying_deg = None
    for angle_deg in np.arange(35.0, 0.0, -0.25):
        if "flap_2" in closed_at(box, flap_0=14.0, flap_2=float(angle_deg)):
            lying_deg = float(angle_deg)
            break
    assert lying_deg is not None
    assert 15.0 < lying_deg < 30.0, "they touch before the second is closed by its own angle"
    assert closed_at(box, flap_0=20.0, flap_2=lying_deg) == set(), "what lies on an open flap is open"


def lidded() -> OpenBox:
    """A lid from side 0 as long as the box is wide, with a tuck; no other flap."""
    lid = carton().flaps[0]
    assert lid is not None
    tuck = Tuck(0.04, float(np.radians(90.0)), 0.01)
    lid = msgspec.structs.replace(lid, length_m=0.21, tuck=tuck)
    return msgspec.structs.replace(carton(), flaps=(lid, None, None, None))


def test_a_tuck_is_closed_when_it_is_in_the_box_under_its_closed_lid() -> None:
    box = true_box(truth_of(lidded()), 0, np.eye(4))
    assert closed_at(box, flap_0=0.0, tuck_0=95.0) == {"flap_0", "tuck_0"}
    assert closed_at(box, flap_0=0.0, tuck_0=0.0) == {"flap_0"}
    assert closed_at(box, flap_0=60.0, tuck_0=95.0) == set()


def test_a_run_that_fails_cannot_tell_a_closed_flap() -> None:
    closed = FlapVerdict(
        before_rad=1.5, pushed_to_rad=0.0, after_rad=0.1, end_rad=0.1, closed=True, held=True, crease_n_m=0.1
    )
    with pytest.raises(ValueError, match="a run that fails proves nothing"):
        Simulation(
            format="boxwright.simulation",
            version=1,
            robot="finger",
            box="true",
            crease="ordinary",
            mass_kg=1.0,
            contents_kg=0.0,
            time_step_s=0.001,
            flaps={"flap_0": closed},
            box_slid_m=0.0,
            box_turned_rad=0.0,
            max_force_n=0.0,
            max_penetration_m=0.0,
            max_joint_error_rad=0.0,
            unwanted=(),
            failure="something sank in",
            warnings=(),
            simulated_s=1.0,
            seconds=1.0,
        )
