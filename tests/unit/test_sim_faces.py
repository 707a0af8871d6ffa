"""The truth about flat faces: which triangles are one, and that readings lie on the plane that is told."""

from __future__ import annotations

import numpy as np
import pytest

from boxwright.simulation import CATEGORIES, NONE, Frame, make_frame
from boxwright.simulation.clutter import SHAPES
from boxwright.simulation.faces import flat_faces
from boxwright.simulation.meshes import cuboid, rectangle, revolve, sphere
from boxwright.simulation.poses import apply, rotation, standing

ROUND = ("ball", "toy")
FLAT = ("book", "books", "blocks", "packet")


@pytest.fixture(scope="module")
def frames() -> list[Frame]:
    return [make_frame(category, 77, index) for index, category in enumerate((*CATEGORIES, NONE, *CATEGORIES))]


def test_a_cuboid_has_six_faces_wherever_it_stands() -> None:
    pose = standing(0.3, -0.2, 1.1, 0.4) @ rotation([1, 2, 3], 0.7)
    faces = flat_faces(apply(pose, cuboid((0.2, 0.1, 0.3))))
    assert np.bincount(faces).tolist() == [2] * 6


def test_round_bodies_have_their_ends_alone() -> None:
    can = revolve([(0, 0), (0.03, 0), (0.03, 0.1), (0, 0.1)])
    faces = flat_faces(can)
    ends = {float(z) for k in range(faces.max() + 1) for z in np.unique(can[faces == k][..., 2])}
    assert ends == {0.0, 0.1}
    assert faces.max() == 1
    assert (flat_faces(sphere(0.1)) < 0).all()
    assert flat_faces(rectangle((1.0, 2.0))).tolist() == [0, 0]


def test_every_face_of_every_thing_is_flat() -> None:
    rng = np.random.default_rng(5)
    checked = 0
    for shape in SHAPES * 3:
        triangles = shape(rng)
        faces = flat_faces(triangles)
        assert ((faces < 0).all()) == (shape.__name__ in ROUND)
        assert ((faces >= 0).all()) == (shape.__name__ in FLAT)
        for k in range(faces.max() + 1):
            corners = triangles[faces == k].reshape(-1, 3)
            thickness = np.linalg.svd(corners - corners.mean(axis=0))[1][2]
            assert thickness < 1e-9, shape.__name__
            checked += 1
    assert checked > 150


def test_panels_are_faces_and_faces_are_counted(frames: list[Frame]) -> None:
    for frame in frames:
        panels = len(frame.truth.parts)
        assert np.array_equal(np.where(frame.faces <= panels, frame.faces, 0), frame.labels)
        assert np.isfinite(frame.points[frame.faces > 0]).all()
        counts = np.bincount(frame.faces, minlength=panels + 1)
        assert counts[panels + 1 :].tolist() == [face.visible_px for face in frame.truth.faces]
        assert (counts[panels + 1 :] > 0).all()


def test_readings_lie_on_the_plane_of_their_face(frames: list[Frame]) -> None:
    """Along the ray, against the sensor's noise at that depth; readings swapped at an edge are off, but few."""
    checked = 0
    for frame in frames:
        for k, face in enumerate(frame.truth.faces, start=len(frame.truth.parts) + 1):
            points = frame.points[frame.faces == k].astype(np.float64)
            normal = np.array(face.normal)
            slope = points @ normal / points[:, 2]
            if len(points) < 200:
                continue
            assert face.distance < 0
            depth_error = (points @ normal - face.distance) / slope
            sigma = 0.001 + 0.0025 * points[:, 2] ** 2
            assert np.mean(np.abs(depth_error) < 4 * sigma) > 0.9, (frame.truth.name, k)
            assert abs(np.median(depth_error / sigma)) < 1.5, (frame.truth.name, k)
            checked += 1
    assert checked >= 50
