"""`boxwright infer --size`, `--catalogue`, and what `--verbose` says of hidden parts."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from boxwright.io.models import load_model
from support.command import boxwright
from support.repository import REPOSITORY

FITTED = ("--method", "fitted")


@pytest.fixture(scope="module")
def large(scene_set: Path) -> tuple[Path, tuple[float, float, float]]:
    """A frame of one large box, and the box's length, width and height at mid-board, m."""
    path = scene_set / "large_0002.pcd"
    dims = json.loads(path.with_name("large_0002.truth.json").read_text())["boxes"][0]["dims"]
    return path, dims


def test_a_size_is_matched_and_told(large: tuple[Path, tuple[float, float, float]], tmp_path: Path) -> None:
    path, dims = large
    length, width, height = (round(1000 * mm) for mm in dims)
    text = f"{height}x{length + 5}X{width + 5}"
    answer = boxwright("infer", path, "-o", tmp_path, *FITTED, "--size", text, "--verbose")
    assert answer.status == 0
    content = json.loads((tmp_path / "large_0002/model.json").read_text())
    jsonschema.validate(content, json.loads((REPOSITORY / "docs/schemas/model.schema.json").read_text()))
    sizes = [found["size"] for found in content["objects"] if found["size"]]
    assert [size["name"] for size in sizes] == [f"{text} mm"]
    assert f"has the size {text} mm" in " ".join(answer.out.split())
    told = [part.name for found in load_model(tmp_path / "large_0002/model.json").objects for part in found.parts
            if part.seen_from is not None]  # fmt: skip
    lines = " ".join(answer.out.split())
    assert all(f"{name}: hidden (" in lines for name in told)


def test_what_was_refused_is_told_on_lines_of_its_own_and_as_json(scene_set: Path, tmp_path: Path) -> None:
    clouds = sorted(scene_set.glob("*.pcd"))
    answer = boxwright("infer", *clouds, "-o", tmp_path, "--json", "--verbose")
    assert answer.status == 0
    refused = [line for told in json.loads(answer.out) for line in told["refused"]]
    assert any(len(line) > 100 for line in refused), "none would be wrapped"
    assert all(line.startswith("no object at (") for line in refused)
    printed = boxwright("infer", *clouds, "-o", tmp_path, "--verbose").out.splitlines()
    assert [line for line in printed if line.startswith("no object at (")] == refused
    (told,) = json.loads(boxwright("infer", clouds[0], "-o", tmp_path, "--json").out)
    assert "refused" not in told


def test_a_catalogue_that_fits_nothing_warns(large: tuple[Path, tuple[float, float, float]], tmp_path: Path) -> None:
    catalogue = tmp_path / "sizes.toml"
    catalogue.write_text(
        '[[size]]\nname = "a"\nouter_mm = [90, 80, 70]\n[[size]]\nname = "b"\nouter_mm = [90, 80, 60]\n'
    )
    answer = boxwright("infer", large[0], "-o", tmp_path / "out", *FITTED, "--catalogue", catalogue)
    assert answer.status == 0
    warnings = load_model(tmp_path / "out/large_0002/model.json").warnings
    assert warnings[0] == "no box in view has the size a (90 x 80 x 70 mm)"
    assert warnings[1] == "no box in view has the size b (90 x 80 x 60 mm)"
    assert all(f"warning: {line}" in answer.err for line in warnings)


def test_nonsense_is_refused_with_the_mend_before_work_starts(frame: Path, tmp_path: Path) -> None:
    refused = (
        ((*FITTED, "--size", "400x300"), 2, "a size is LxWxH over the boards in mm"),
        ((*FITTED, "--catalogue", "gone.toml"), 1, "gone.toml"),
        (("--method", "paper", "--size", "400x300x200"), 2, "add --method fitted"),
    )
    for options, status, mend in refused:
        answer = boxwright("infer", frame, "-o", tmp_path / "out", *options, folder=tmp_path)
        assert answer.status == status, options
        assert mend in " ".join(answer.err.replace("│", " ").split()), answer.err
    assert not (tmp_path / "out").exists()
