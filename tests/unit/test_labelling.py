"""Labels from people: roles, forms, and the labelled frame that a form comes to."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import msgspec
import numpy as np
import pytest

from boxwright.evaluation import summarize
from boxwright.io.truth import load_truth, save_truth
from boxwright.labelling import LabelledEntry, Role, form_text, labelled_entry, read_form, read_role, save_entry
from boxwright.models import load_template
from boxwright.types import Cloud, Seconds, Segment, Segmentation, Source, SupportPlane
from support.labelled_scenes import CAMERA, perfect_scene
from support.random_models import random_angles, random_spec

CARTON = load_template("carton")
UP = (0.0, 0.0, 1.0)
READINGS = 50


def _segment(middle: tuple[float, float, float], along: tuple[float, float, float], normal: tuple[float, float, float]):
    """A rectangle, 0.2 m along, 0.1 m across."""
    m, a, n = (np.array(v, float) for v in (middle, along, normal))
    corners = [m + 0.1 * s * a + 0.05 * t * np.cross(n, a) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    rectangle = tuple(tuple(float(c) for c in corner) for corner in corners)
    return Segment(
        normal=normal, distance=float(m @ n), rms=0.001, points=READINGS, rectangle=rectangle,
        edges=("edge",) * 4, hull=rectangle, group=0,
    )  # fmt: skip


SIDES = (
    _segment((0.0, -0.1, 0.1), (1, 0, 0), (0, -1, 0)),
    _segment((0.1, 0.0, 0.1), (0, 1, 0), (1, 0, 0)),
    _segment((0.0, 0.1, 0.1), (-1, 0, 0), (0, 1, 0)),
    _segment((-0.1, 0.0, 0.1), (0, -1, 0), (-1, 0, 0)),
    # Goes on from the first.
    _segment((0.25, -0.1, 0.1), (1, 0, 0), (0, -1, 0)),
    _segment((0.0, 0.0, 0.3), (1, 0, 0), (0, 0, 1)),
)
"""Four sides, counter-clockwise seen from above, and two more."""


def _segmentation(segments: tuple[Segment, ...] = SIDES) -> Segmentation:
    return Segmentation(
        format="boxwright.segments",
        version=1,
        source=Source(file="f.pcd", points=READINGS * len(segments), organized=False),
        warnings=(),
        seconds=Seconds(read=0.0, stages={}, total=0.0),
        up=UP,
        support_plane=SupportPlane(normal=UP, distance=0.0),
        segments=segments,
    )


def _entry(tmp_path: Path, roles: dict[int, str]) -> LabelledEntry:
    path = tmp_path / "f.roles.toml"
    path.write_text(form_text(_segmentation(), CARTON, "mine", "f.png", roles), encoding="utf-8")
    segment_of = np.repeat(np.arange(-1, len(SIDES), dtype=np.int32), READINGS)
    return labelled_entry("f", read_form(path), _segmentation(), segment_of, CARTON)


def test_roles_as_people_type_them() -> None:
    assert read_role("", CARTON) is None
    assert read_role("  ", CARTON) is None
    assert read_role(" side_0 ", CARTON) == Role("", "side_0")
    assert read_role("a.flap_3", CARTON) == Role("a", "flap_3")
    refusals = {
        "side_4": "carton has no part 'side_4'; known are base, side_0",
        "a.side0": "carton has no part 'side0'",
        "tuck_0": "'tuck_0' is a part of cake_box, not of carton",
        ".base": "'' is no box's name",
        "big box.base": "'big box' is no box's name",
    }
    for text, reason in refusals.items():
        with pytest.raises(ValueError, match=reason):
            read_role(text, CARTON)


def test_a_form_tells_what_each_segment_is_like_and_keeps_what_was_typed(tmp_path: Path) -> None:
    text = form_text(_segmentation(), CARTON, 'my "box"', "f.png", {1: "side_1"})
    assert '1  = "side_1"  # 50 readings, 200 x 100 mm, 100 mm above the support, tilt 90 deg' in text
    path = tmp_path / "f.roles.toml"
    path.write_text(text, encoding="utf-8")
    form = read_form(path)
    assert (form.points, form.template, form.category) == (300, "carton", 'my "box"')
    assert form.roles == {k: "side_1" if k == 1 else "" for k in range(len(SIDES))}
    assert not form.is_empty
    lines = text.splitlines()
    assert all(lines[form.lines[k] - 1].startswith(f"{k} ") for k in form.roles)


def test_a_form_that_is_wrong_is_refused_with_file_and_line(tmp_path: Path) -> None:
    good = form_text(_segmentation(), CARTON, "carton", "f.png")
    line = next(k for k, text in enumerate(good.splitlines(), 1) if text.startswith("2 "))
    changes = {
        '2  = "side_7"': rf"f\.roles\.toml: line {line}: role 'side_7'",
        '9  = "side_1"': rf"f\.roles\.toml: line {line}: there is no segment 9; they go to 5",
        'two = "side_1"': rf"f\.roles\.toml: line {line}: 'two' is no segment's number",
        "2  = side_1": rf"f\.roles\.toml: .*line {line}",
        "2  = 7": r"f\.roles\.toml: .*roles",
        '1  = ""': r"f\.roles\.toml: .*overwrite",
    }
    for typed, place in changes.items():
        path = tmp_path / "f.roles.toml"
        path.write_text(good.replace('2  = ""', typed), encoding="utf-8")
        with pytest.raises(ValueError, match=place):
            labelled_entry("f", read_form(path), _segmentation(), np.zeros(4, np.int32), CARTON)


def test_what_was_typed_becomes_truth_and_labels(tmp_path: Path) -> None:
    entry = _entry(tmp_path, {0: "a.side_0", 4: "a.side_0", 1: "a.side_1", 5: "b.flap_2", 2: " "})
    truth = entry.truth
    assert entry.warnings == ()
    assert (truth.camera, truth.category, truth.up) == (None, "mine", UP)
    assert [(box.index, box.dims) for box in truth.boxes] == [(0, None), (1, None)]
    told = [(part.box, part.name, part.parent, part.angle_deg, part.visible_px) for part in truth.parts]
    assert told == [
        (0, "side0", None, None, 2 * READINGS),
        (0, "side1", None, None, READINGS),
        (1, "flap2", "side2", None, READINGS),
    ]
    assert np.unique(entry.labels, return_counts=True)[1].tolist() == [3 * READINGS, 2 * READINGS, READINGS, READINGS]
    corners = np.array(truth.parts[0].corners)
    np.testing.assert_allclose(corners.min(axis=0), (-0.1, -0.1, 0.05), atol=1e-12)
    np.testing.assert_allclose(corners.max(axis=0), (0.35, -0.1, 0.15), atol=1e-12)
    path = tmp_path / "f.truth.json"
    save_truth(truth, path)
    assert load_truth(path) == truth


def test_pieces_that_cannot_be_one_panel_are_told(tmp_path: Path) -> None:
    (warning,) = _entry(tmp_path, {0: "side_0", 2: "side_0"}).warnings
    assert "segment 2 is turned 0 deg and 200 mm off from the other pieces of side_0" in warning
    assert "f.roles.toml: line " in warning
    (warning,) = _entry(tmp_path, {0: "side_0", 1: "side_0"}).warnings
    assert "turned 90 deg" in warning


def test_a_box_numbered_the_wrong_way_round_is_refused(tmp_path: Path) -> None:
    right = {k: f"side_{k}" for k in range(4)}
    assert len(_entry(tmp_path, right).truth.parts) == 4
    assert len(_entry(tmp_path, {k: f"side_{(k + 3) % 4}" for k in range(4)}).truth.parts) == 4
    assert len(_entry(tmp_path, {0: "side_1", 1: "side_0"}).truth.parts) == 2, "two sides do not tell"
    for wrong in ({k: f"side_{3 - k}" for k in range(4)}, {0: "side_0", 1: "flap_3", 3: "side_1"}):
        with pytest.raises(ValueError, match=r"line \d+: the box is numbered clockwise"):
            _entry(tmp_path, wrong)


def test_a_truth_that_was_measured_is_not_overwritten(tmp_path: Path) -> None:
    entry = _entry(tmp_path, {0: "side_0"})
    cloud = Cloud(points=np.zeros((350, 3), np.float32), width=350, height=1)
    for _ in range(2):
        assert [path.name for path in save_entry(tmp_path, cloud, entry)] == ["f.pcd", "f.truth.json", "f.labels.npz"]
    save_truth(msgspec.structs.replace(entry.truth, camera=CAMERA), tmp_path / "f.truth.json")
    with pytest.raises(ValueError, match=r"f\.truth\.json: is no person's labelling"):
        save_entry(tmp_path, cloud, entry)


def test_what_a_person_cannot_measure_is_left_out_of_the_figures() -> None:
    rng = np.random.default_rng(4)
    spec = random_spec(rng)
    whole = perfect_scene([(spec, random_angles(spec, rng), {})])
    first = whole.truth.boxes[0]
    unmeasured = replace(
        whole,
        truth=msgspec.structs.replace(
            whole.truth,
            camera=None,
            boxes=(msgspec.structs.replace(first, dims=None),),
            parts=tuple(msgspec.structs.replace(part, angle_deg=None) for part in whole.truth.parts),
        ),
    )
    measured, told = (summarize([scene.score()]).category("all") for scene in (whole, unmeasured))
    assert measured.flaps_in_cloud > 0
    assert (measured.usable_flaps_percent, measured.hinge_angle_deg.count) == (100.0, measured.flaps_in_cloud)
    assert (told.full_accuracy_percent, told.flaps_right) == (100.0, measured.flaps_right)
    assert told.usable_flaps_percent is None
    assert (told.hinge_angle_deg.count, told.flap_angle_deg.count, told.dimension_mm.count) == (0, 0, 0)
