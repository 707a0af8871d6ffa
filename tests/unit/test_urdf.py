"""The written URDF: masses, inertias, root, refusals, equal bytes."""

from __future__ import annotations

import io
import xml.etree.ElementTree as ET
from pathlib import Path

import msgspec
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from boxwright.kinematics import save_urdf, urdf_text
from boxwright.kinematics.plates import plate
from boxwright.kinematics.transforms import roll_pitch_yaw
from boxwright.types import Object
from support.random_models import random_angles, random_object, random_spec
from support.sample_model import sample_null_object, sample_object


def test_a_rectangle_has_the_textbook_inertia() -> None:
    a, b, t, weight = 0.4, 0.3, 0.005, 600.0
    corners = np.array([[0, 0, 0], [a, 0, 0], [a, b, 0], [0, b, 0]], float)
    body = plate(corners, np.array([0.0, 0.0, 1.0]), weight, t)
    mass_kg = 0.072
    assert body.mass_kg == pytest.approx(mass_kg, rel=1e-12)
    np.testing.assert_allclose(body.centre, [a / 2, b / 2, 0], atol=1e-15)
    expected = mass_kg / 12 * np.diag([b * b + t * t, a * a + t * t, a * a + b * b])
    np.testing.assert_allclose(body.inertia, expected, atol=1e-15)


def test_a_tapered_plate_agrees_with_a_sum_over_small_pieces() -> None:
    corners = np.array([[0, 0, 0], [0.4, 0, 0], [0.35, 0.2, 0], [0.1, 0.2, 0]])
    body = plate(corners, np.array([0.0, 0.0, 1.0]), 500.0, 0.004)
    n = 800
    s, v = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) / n)
    left, right = 0.1 * v, 0.4 - 0.05 * v
    x, y, weight = left + s * (right - left), 0.2 * v, (right - left) * 0.2 / n / n * 0.5
    mass_kg, cx, cy = weight.sum(), (weight * x).sum() / weight.sum(), (weight * y).sum() / weight.sum()
    board = mass_kg * 0.004**2 / 12
    xx, yy = (weight * (x - cx) ** 2).sum(), (weight * (y - cy) ** 2).sum()
    xy = (weight * (x - cx) * (y - cy)).sum()
    np.testing.assert_allclose([body.mass_kg, *body.centre], [mass_kg, cx, cy, 0], rtol=1e-5, atol=1e-12)
    expected = [[yy + board, -xy, 0], [-xy, xx + board, 0], [0, 0, xx + yy]]
    np.testing.assert_allclose(body.inertia, expected, rtol=1e-5, atol=1e-12)


def test_roll_pitch_yaw_agrees_with_scipy_and_holds_near_the_pole() -> None:
    rng = np.random.default_rng(5)
    rotations = [Rotation.random(rng=rng).as_matrix() for _ in range(200)]
    rotations += [
        Rotation.from_euler("xyz", [roll, sign * np.pi / 2 + off, yaw]).as_matrix()
        for roll, yaw in rng.uniform(-3, 3, (50, 2))
        for sign in (1, -1)
        for off in (0.0, 1e-9, -1e-6)
    ]
    for rotation in rotations:
        again = Rotation.from_euler("xyz", roll_pitch_yaw(rotation)).as_matrix()
        np.testing.assert_allclose(again, rotation, atol=1e-14)
    assert len(rotations) == 500


def test_mass_follows_the_stated_board(tmp_path: Path) -> None:
    model_object = msgspec.convert(sample_object(), Object)
    save_urdf(model_object, tmp_path / "box_0.urdf", board_g_per_m2=1000.0)
    masses = {
        link.get("name"): float(link.find("inertial/mass").get("value"))  # type: ignore[union-attr, arg-type]
        for link in ET.parse(tmp_path / "box_0.urdf").getroot().iter("link")
    }
    assert masses == {"side_0": pytest.approx(0.08), "flap_0": pytest.approx(0.04)}
    assert (tmp_path / "box_0.urdf").read_text() == urdf_text(model_object, board_g_per_m2=1000.0)


def test_the_measured_position_and_the_board_are_told() -> None:
    model_object = msgspec.convert(sample_object(), Object)
    text = urdf_text(model_object)
    assert "Measured positions, rad: hinge_0 1.5707963267948966." in text
    assert "0.004 m thick (told by the model)" in text
    assert "0.003 m thick (assumed)" in urdf_text(
        msgspec.structs.replace(model_object, thickness=None), board_thickness_m=0.003
    )


def test_a_root_can_be_named_and_is_checked() -> None:
    rng = np.random.default_rng(3)
    spec = random_spec(rng)
    model_object = random_object(spec, random_angles(spec, rng))
    text = urdf_text(model_object, root="side_2")
    parents = {parent.get("link") for parent in ET.parse(io.StringIO(text)).getroot().iter("parent")}
    children = {child.get("link") for child in ET.parse(io.StringIO(text)).getroot().iter("child")}
    assert "side_2" in parents - children
    for wrong in ("lid", f"flap_{spec.flaps[0].side}"):
        with pytest.raises(ValueError, match="must be a fixed part with corners"):
            urdf_text(model_object, root=wrong)


def test_what_cannot_be_a_robot_is_refused() -> None:
    data = sample_null_object()
    data["parts"] = [dict(part, corners=None, observed=False) for part in data["parts"]]
    with pytest.raises(ValueError, match="no fixed part with corners"):
        urdf_text(msgspec.convert(data, Object))
    data = sample_object()
    data["parts"][1]["corners"] = [[0, 0, 0], [0.4, 0, 0], [0.4, 0, 0], [0, 0, 0]]
    with pytest.raises(ValueError, match="part 'flap_0' has corners on one line"):
        urdf_text(msgspec.convert(data, Object))
    with pytest.raises(ValueError, match="must be above 0"):
        urdf_text(msgspec.convert(sample_object(), Object), board_g_per_m2=0.0)
