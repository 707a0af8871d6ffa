"""Scenes by URDF: what is read, and what is refused before the arm goes through it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from boxwright.planning import read_scene


def scene(folder: Path, geometry: str, *, kind: str = "collision", origin: str = 'xyz="0.5 0 0.2"') -> Path:
    path = folder / "fence.urdf"
    path.write_text(
        f'<robot name="s"><link name="world"/><link name="fence"><{kind}><origin {origin}/>'
        f"<geometry>{geometry}</geometry></{kind}></link>"
        '<joint name="stand" type="fixed"><parent link="world"/><child link="fence"/></joint></robot>',
        encoding="utf-8",
    )
    return path


@pytest.mark.parametrize(
    ("geometry", "size_m"),
    [
        ('<box size="0.4 0.3 0.05"/>', [0.4, 0.3, 0.05]),
        ('<cylinder radius="0.1" length="0.7"/>', [0.2, 0.2, 0.7]),
        ('<sphere radius="0.1"/>', [0.2, 0.2, 0.2]),
    ],
)
def test_shapes_are_read_as_the_boxes_around_them(geometry: str, size_m: list[float], tmp_path: Path) -> None:
    (thing,) = read_scene(scene(tmp_path, geometry))
    assert thing["name"] == "fence"
    assert thing["size_m"] == size_m
    np.testing.assert_allclose(thing["centre_m"], [0.5, 0.0, 0.2])


REFUSED = [
    (
        '<box size="0.4 0.4 -0.05"/>',
        "link 'fence': box size is '0.4 0.4 -0.05'; must be 3 finite numbers above 0, metres",
    ),
    ('<box size="0 0.4 0.5"/>', "link 'fence': box size is '0 0.4 0.5'; must be 3 finite numbers above 0, metres"),
    ('<box size="nan 1 1"/>', "link 'fence': box size is 'nan 1 1'; must be 3 finite numbers above 0"),
    ('<box size="inf 1 1"/>', "link 'fence': box size is 'inf 1 1'; must be 3 finite numbers above 0"),
    ('<box size="a b c"/>', "link 'fence': box size is 'a b c'; must be 3 finite numbers above 0"),
    ('<box size="0.4 0.4"/>', "link 'fence': box size is '0.4 0.4'; must be 3 finite numbers above 0"),
    ('<sphere radius="-0.1"/>', "link 'fence': sphere radius is '-0.1'; must be a finite number above 0, metres"),
    ('<cylinder radius="nan" length="1"/>', "link 'fence': cylinder radius is 'nan'; must be a finite number above 0"),
    ('<cylinder radius="0.1" length="-1"/>', "link 'fence': cylinder length is '-1'; must be a finite number above 0"),
    ('<cylinder radius="0.1"/>', "link 'fence': cylinder length is ''; must be a finite number above 0"),
    ('<mesh filename="a.stl"/>', "link 'fence': its collision geometry is a mesh; give a box, cylinder or sphere"),
    ("", "link 'fence': its collision geometry is empty; give a box, cylinder or sphere"),
]


def refusal(path: Path) -> str:
    with pytest.raises(ValueError, match=r".") as caught:
        read_scene(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(("geometry", "told"), REFUSED)
def test_a_shape_that_is_none_is_refused_with_file_and_link(geometry: str, told: str, tmp_path: Path) -> None:
    assert told in refusal(scene(tmp_path, geometry))


@pytest.mark.parametrize("key", ["xyz", "rpy"])
@pytest.mark.parametrize("value", ["nan 0 0.3", "0 0", "a b c"])
def test_a_place_that_is_none_is_refused_with_file_and_link(key: str, value: str, tmp_path: Path) -> None:
    path = scene(tmp_path, '<sphere radius="0.1"/>', origin=f'{key}="{value}"')
    assert f"link 'fence': origin {key} is '{value}'; must be 3 finite numbers" in refusal(path)


def test_a_thing_that_is_only_to_be_seen_is_not_passed_over(tmp_path: Path) -> None:
    told = refusal(scene(tmp_path, '<box size="0.4 0.4 0.05"/>', kind="visual"))
    assert "link 'fence' has a <visual> and no <collision>" in told
    assert "give it a <collision> of the same shape, or take it out" in told
