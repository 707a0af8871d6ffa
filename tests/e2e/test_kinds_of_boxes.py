"""Templates that compete for fitted boxes, by the command."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from boxwright.io.labels import read_labels
from boxwright.io.models import load_model
from boxwright.simulation import make_frame, write_frame
from boxwright.types.model import Model
from support.command import boxwright

SIDES = ("side_0", "side_1", "side_2", "side_3")
TOTE_LEAN_DEG = 5.0
"""Sections across the cloud: medians by height say 4.9 to 5.4, of one wall that the fused views blur 3 to 5."""


def _infer(cloud: Path, out: Path, *options: str) -> Model:
    answer = boxwright("infer", cloud, "-o", out, "--method", "fitted", *options)
    assert answer.status == 0, answer.err
    return load_model(out / cloud.stem / "model.json")


@pytest.fixture(scope="module")
def frame(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("bin")
    made = make_frame("tote", 12, 0, boxes=1, clutter=False)
    write_frame(folder, made)
    return folder / f"{made.truth.name}.pcd"


def test_a_bin_is_a_tote_among_all_and_a_carton_where_no_tote_is_asked_for(frame: Path, tmp_path: Path) -> None:
    (found,) = _infer(frame, tmp_path / "all").objects
    assert found.template == "tote"
    assert found.template_probability is not None
    assert found.template_probability > 0.5
    (other,) = _infer(frame, tmp_path / "two", "--template", "carton", "--template", "pizza_box").objects
    assert other.template in ("carton", "pizza_box")
    assert other.template_probability is not None
    assert other.template_probability > 0.5
    (alone,) = _infer(frame, tmp_path / "one", "--template", "cake_box").objects
    assert (alone.template, alone.template_probability) == ("cake_box", 1.0)
    assert found.dimensions == other.dimensions == alone.dimensions


def test_what_a_tote_lacks_is_not_told(frame: Path, tmp_path: Path) -> None:
    (found,) = _infer(frame, tmp_path, "--template", "tote").objects
    assert [part.name for part in found.parts] == ["base", *SIDES]
    assert found.joints == ()
    assert not [name for name in found.parameters if name.startswith(("flap", "tuck"))]
    labels = read_labels(tmp_path / frame.stem / "labels.npz")
    counts = np.bincount(labels.part[labels.object == 0], minlength=5)
    assert counts.tolist() == [part.points for part in found.parts]


def test_the_real_tote_is_one_tote_with_sloping_walls(shared_dir: Path, tmp_path: Path) -> None:
    model = _infer(shared_dir / "data/real/tote_apc/tote_fused_model.pcd", tmp_path)
    (found,) = model.objects
    assert found.template == "tote"
    assert all(part.observed for part in found.parts)
    assert [part.name for part in found.parts] == ["base", *SIDES]
    assert model.free_space == "no viewpoint"
    assert any("free space was not used" in warning for warning in model.warnings)
    leans = [math.degrees(found.parameters[f"{side}_lean"].value) for side in SIDES]
    assert all(abs(lean - TOTE_LEAN_DEG) < 1.5 for lean in leans), leans
