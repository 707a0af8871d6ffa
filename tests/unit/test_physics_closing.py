"""Flaps pushed shut in physics by a scripted finger: springing back, order, time step, and what makes a run fail."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
import pytest

from boxwright.simulation.physics import BoardBox, Load, PhysicsSettings, load_creases, simulate_closing, true_box
from boxwright.simulation.physics.commands import course_of
from boxwright.simulation.physics.look import look_again
from boxwright.types import PlanSegment, Simulation
from support.finger import Finger, push_shut
from support.true_boxes import carton, truth_of

HEAVY = Load(mass_kg=4.0)


def closing(box: BoardBox, flaps: Sequence[str], to_deg: float = 0.0) -> list[PlanSegment]:
    """One flap after the other."""
    segments: list[PlanSegment] = []
    for flap in flaps:
        start = (segments[-1].times[-1], np.array(segments[-1].positions[-1])) if segments else None
        segments += push_shut(box, flap, to_deg, start=start)
    return segments


def standing(*angles_deg: float) -> BoardBox:
    return true_box(truth_of(carton(*angles_deg)), 0, np.eye(4))


def verdict_alone(simulation: Simulation) -> Simulation:
    """Without the time that it took."""
    return msgspec.structs.replace(simulation, seconds=0.0)


def test_a_flap_let_go_springs_back_as_its_crease_says() -> None:
    box, counted = standing(), 0
    for name, crease in load_creases().classes.items():
        flap = simulate_closing(box, Finger(), closing(box, ["flap_1"]), name, load=HEAVY).simulation.flaps["flap_1"]
        assert flap.pushed_to_rad is not None
        assert abs(np.degrees(flap.pushed_to_rad)) < 2.5
        returned_deg = float(np.degrees(flap.after_rad - flap.pushed_to_rad))
        # Its weight bends the crease back by less than a degree and a half.
        assert crease.return_deg - 1.5 < returned_deg < crease.return_deg
        assert flap.closed == flap.held == (name != "stiff")
        counted += 1
    assert counted == 3


def test_minor_flaps_then_major_ones_close_the_box() -> None:
    box = standing()
    run = simulate_closing(box, Finger(), closing(box, ["flap_1", "flap_3", "flap_0", "flap_2"]), load=HEAVY)
    simulation = run.simulation
    assert simulation.failure is None
    assert not simulation.unwanted
    assert all(flap.held for flap in simulation.flaps.values()), simulation.flaps
    # The minor flaps sprang up, and lie pressed down by the major ones.
    for minor in ("flap_1", "flap_3"):
        assert simulation.flaps[minor].end_rad < simulation.flaps[minor].after_rad - np.radians(4.0)
    assert simulation.box_slid_m < 0.002
    assert simulation.max_penetration_m < 0.0005


@pytest.mark.parametrize(
    ("crease", "load", "flaps"),
    [
        ("pre_broken", HEAVY, ["flap_1", "flap_0"]),
        ("ordinary", HEAVY, ["flap_1"]),
        ("stiff", HEAVY, ["flap_1"]),
        ("ordinary", Load(empty=True), ["flap_1"]),
    ],
)
def test_half_the_time_step_gives_the_same_verdicts(crease: str, load: Load, flaps: list[str]) -> None:
    box = standing()
    coarse, fine = (
        simulate_closing(
            box, Finger(), closing(box, flaps), crease, load=load, settings=PhysicsSettings(time_step_s=step_s)
        ).simulation
        for step_s in (0.001, 0.0005)
    )
    assert coarse.failure is None
    assert fine.failure is None
    assert coarse.unwanted == fine.unwanted
    assert len(coarse.flaps) == 4
    for name, flap in coarse.flaps.items():
        assert (flap.closed, flap.held) == (fine.flaps[name].closed, fine.flaps[name].held), name


def test_the_same_run_gives_the_same_bits() -> None:
    box = standing(100.0, 80.0, 70.0, 95.0)
    first, second = (
        simulate_closing(box, Finger(), closing(box, ["flap_1"]), load=Load(empty=True)).simulation for _ in range(2)
    )
    assert verdict_alone(first) == verdict_alone(second)


def test_a_light_box_slides_where_a_heavy_one_stands() -> None:
    box = standing()
    slid_m = [
        simulate_closing(box, Finger(), closing(box, ["flap_1"]), "stiff", load=load).simulation.box_slid_m
        for load in (Load(empty=True), HEAVY)
    ]
    assert slid_m[0] > 0.02
    assert slid_m[1] < 0.001


def test_what_touches_more_than_the_flap_is_told() -> None:
    box = standing(95.0, 95.0, 95.0, 95.0)
    segments = closing(box, ["flap_1"])
    for segment in segments:
        assert segment.kind in ("approach", "push", "retreat")
    as_if_other = [
        segment if segment.flap is None else msgspec.structs.replace(segment, flap="flap_3") for segment in segments
    ]
    simulation = simulate_closing(box, Finger(), as_if_other, load=HEAVY).simulation
    assert simulation.unwanted == (("finger", "flap_1"),)
    assert simulation.flaps["flap_3"].pushed_to_rad == pytest.approx(simulation.flaps["flap_3"].before_rad, abs=0.01)


def test_a_flap_that_the_box_lacks_is_told_and_the_arm_moves_all_the_same() -> None:
    box = standing()
    bare = msgspec.structs.replace(box, boards=tuple(board for board in box.boards if board.name != "flap_1"))
    simulation = simulate_closing(bare, Finger(), closing(box, ["flap_1"]), load=HEAVY).simulation
    assert simulation.warnings == ("flap_1 is pushed, and this box has no such flap",)
    assert "flap_1" not in simulation.flaps


def test_sinking_in_fails_the_run() -> None:
    box = standing()
    soft = PhysicsSettings(contact_time_s=0.1, contact_impedance=0.5)
    simulation = simulate_closing(box, Finger(), closing(box, ["flap_1"]), load=HEAVY, settings=soft).simulation
    assert simulation.failure is not None
    assert "proves nothing" in simulation.failure
    assert not any(flap.closed or flap.held for flap in simulation.flaps.values())


def test_a_strong_finger_does_not_pass_through_thin_board() -> None:
    """Pressed against the floor of a flat box by all that the finger's drives can: 40 N on a board of 1.5 mm."""
    flat = msgspec.structs.replace(carton(), height_m=0.04, board_m=0.0015)
    box = true_box(truth_of(flat), 0, np.eye(4))
    for to_deg in (0.0, -40.0):
        run = simulate_closing(box, Finger(), closing(box, ["flap_1"], to_deg), load=Load(mass_kg=2.0))
        assert run.simulation.failure is None, run.simulation.failure
        assert run.simulation.max_penetration_m < 0.001


def test_courses_pass_through_the_samples_with_their_speeds() -> None:
    times = (0.0, 0.1, 0.25, 0.4)
    segment = PlanSegment(
        flap=None,
        kind="transit",
        times=times,
        positions=tuple((t**3, 1.0 - t) for t in times),
        velocities=tuple((3.0 * t**2, -1.0) for t in times),
        gripper_opening_m=0.0,
    )
    course, at = course_of(segment, 0.001), 0.001 * np.arange(400)
    np.testing.assert_allclose(course.positions, np.column_stack([at**3, 1.0 - at]), atol=1e-12)
    np.testing.assert_allclose(course.velocities, np.column_stack([3.0 * at**2, np.full(400, -1.0)]), atol=1e-10)
    np.testing.assert_allclose(course.accelerations, np.column_stack([6.0 * at, np.zeros(400)]), atol=1e-8)


def test_the_sensor_sees_the_box_as_physics_left_it() -> None:
    x, y, z = (0.0, 0.0, 1.2)
    base_from_input = np.array([[1.0, 0, 0, x], [0, -0.8, -0.6, y + 0.72], [0, 0.6, -0.8, z - 0.2], [0, 0, 0, 1]])
    box = standing()
    run = simulate_closing(box, Finger(), closing(box, ["flap_1"]), load=HEAVY)
    frame = look_again([run.box], base_from_input, seed=3)
    again = true_box(frame.truth, 0, base_from_input)
    for board in run.box.boards:
        np.testing.assert_allclose(again.board(board.name).corners, board.corners, atol=1e-9)
    (flap,) = [hinge for board, hinge in again.hinged if board.name == "flap_1"]
    assert flap.position_rad == pytest.approx(run.simulation.flaps["flap_1"].end_rad)
    seen = {part.name: part.visible_px for part in frame.truth.parts}
    assert min(seen["flap1"], seen["flap0"], seen["side0"]) > 400, seen
    assert again.thickness_m == pytest.approx(box.thickness_m)
