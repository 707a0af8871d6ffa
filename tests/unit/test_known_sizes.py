"""Outer sizes that are known: catalogues, what is refused, and what an answer says of them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest
import typer

import boxwright
from boxwright.cli.values import OuterSize
from boxwright.types import KnownSize, Object
from support.second_view import SeenScene, draw, true_names

CATALOGUE = """\
[[size]]
name = "A4 carton"
outer_mm = [305, 220, 250]

[[size]]
name = "flat"
outer_mm = [400, 300.5, 60]
"""

BAD = (
    ("", "missing required field `size`"),
    ("size = []", "holds no sizes"),
    ("[[size]]\nname = 'a'", "missing required field `outer_mm`"),
    ("[[size]]\nname = 'a'\nouter_mm = [1, 2]", "length 3"),
    ("[[size]]\nname = 'a'\nouter_mm = [0.4, 0.3, 0.2]", 'size 1: size "a" has a length of 0.4 mm'),
    ("[[size]]\nname = 'a'\nouter_mm = [400, 300, -200]", "size 'a': outer_mm holds -200.0; it must be above 0"),
    ("[[size]]\nname = 'a'\nouter_mm = [400, 300, nan]", "size 'a': outer_mm holds nan, which is no number"),
    ("[[size]]\nname = ' '\nouter_mm = [400, 300, 200]", "name is empty"),
    ("[[size]]\nname = 'a'\nouter_mm = [400, 300, 200]\nweight = 3", "unknown field `weight`"),
    (CATALOGUE + CATALOGUE, "size 3: 'A4 carton' is there already"),
    ("[[size", "Expected ']]'"),
)


def test_a_catalogue_is_read_in_its_order(tmp_path: Path) -> None:
    path = tmp_path / "sizes.toml"
    path.write_text(CATALOGUE)
    assert boxwright.read_sizes(path) == (
        KnownSize(name="A4 carton", outer=(0.305, 0.22, 0.25)),
        KnownSize(name="flat", outer=(0.4, 0.3005, 0.06)),
    )


def test_bad_catalogues_name_file_and_fault(tmp_path: Path) -> None:
    path = tmp_path / "sizes.toml"
    for text, fault in BAD:
        path.write_text(text)
        with pytest.raises(ValueError, match=r"sizes\.toml: ") as refusal:
            boxwright.read_sizes(path)
        line = str(refusal.value)
        assert line.startswith(str(path)), line
        assert fault in line, line
        assert "\n" not in line, line
    assert len(BAD) == 11


NONSENSE = (
    ("400x300", "is not three lengths"),
    ("400x300x200x100", "is not three lengths"),
    ("400x300xtall", "is not three lengths"),
    ("400,300,200", "is not three lengths"),
    ("0.4x0.3x0.2", "has a length of 0.4 mm"),
    ("4000x300x200", "has a length of 4000 mm"),
    ("400x300x-200", "above 0"),
    ("nanx300x200", "size 'nanx300x200': outer_mm holds nan, which is no number; it must be above 0"),
)


def test_sizes_on_the_command_line_are_three_lengths_in_millimetres() -> None:
    assert OuterSize.parse("400x300.5X200").outer_mm == (400.0, 300.5, 200.0)
    for text, fault in NONSENSE:
        with pytest.raises(typer.BadParameter, match=fault) as refusal:
            OuterSize.parse(text)
        assert "400x300x200" in refusal.value.message
    assert len(NONSENSE) == 8


def test_methods_that_know_no_sizes_say_so() -> None:
    scene = draw("small", 3, 0)
    with pytest.raises(ValueError, match="give them to method 'fitted'"):
        boxwright.infer(scene.cloud, method="paper", sizes=[KnownSize(name="a", outer=(0.4, 0.3, 0.2))])


def test_a_box_of_a_given_size_is_taken_to_have_it() -> None:
    """The true outer size, in another order, beside another size: the box is measured better than without."""
    before, after, counted = [], [], 0
    for index, category in enumerate(("small", "carton", "medium", "large")):
        scene = draw(category, 3, index)
        box = scene.scene.boxes[0].box
        true_m = (box.length_m + box.board_m, box.width_m + box.board_m, box.height_m)
        sizes = [
            KnownSize(name="long", outer=(true_m[0] * 1.3, true_m[1], true_m[2])),
            KnownSize(name="true", outer=(true_m[2], true_m[0], true_m[1])),
        ]
        plain = _object(scene, ())
        given = _object(scene, sizes)
        if plain is None or given is None or given.size is None:
            continue
        counted += 1
        assert given.size.name == "true"
        assert plain.size is None
        assert sorted(given.size.outer_dimensions) == pytest.approx(sorted(true_m))
        before += _errors(plain, true_m)
        after += _errors(given, true_m)
    assert counted >= 3
    assert float(np.median(after)) < 0.002
    assert float(np.mean(after)) < float(np.mean(before))


def test_a_size_that_fits_no_box_says_so() -> None:
    scene = draw("carton", 3, 1)
    answer = boxwright.infer(scene.cloud, method="fitted", sizes=[KnownSize(name="crate", outer=(1.2, 0.8, 0.6))]).model
    assert answer.objects
    assert all(found.size is None for found in answer.objects)
    assert answer.warnings[0] == "no box in view has the size crate (1200 x 800 x 600 mm)"
    assert all("the nearest is crate" in line for line in answer.warnings[1:])
    assert len(answer.warnings) == 1 + len(answer.objects)


def _object(scene: SeenScene, sizes: Sequence[KnownSize]) -> Object | None:
    found = boxwright.infer(scene.cloud, method="fitted", sizes=sizes).model.objects
    return next((one for one in found if true_names(one, scene.frame, 0)), None)


def _errors(found: Object, true_m: tuple[float, float, float]) -> list[float]:
    assert found.outer_dimensions is not None
    (length, width, height), (true_length, true_width, true_height) = found.outer_dimensions, true_m
    if abs(length - true_length) + abs(width - true_width) > abs(length - true_width) + abs(width - true_length):
        length, width = width, length
    return [abs(length - true_length), abs(width - true_width), abs(height - true_height)]
