"""What a user says of a scene (up, viewpoint, region, front end), and what is said where it cannot be meant."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import typer

import boxwright
from boxwright.cli.values import Triple
from boxwright.perception import perceive
from boxwright.pipeline import FEWEST_PIXELS
from boxwright.segmentation import segment
from boxwright.types import Cloud, PosedCloud


def _tray(width: int = 160, height: int = 120) -> Cloud:
    """A floor with a wall before it, as a camera sees them from 1 m."""
    v, u = np.mgrid[0:height, 0:width] / (width / 160.0)
    depth = np.where(v < 60.0, 1.0, 1.0 / ((v - 60.0) / 140.0 + 1.0))
    points = np.stack([(u - 80.0) / 140.0 * depth, (v - 60.0) / 140.0 * depth, depth], axis=-1)
    return Cloud(points=points.reshape(-1, 3).astype(np.float32), width=width, height=height, viewpoint=(0.0, 0.0, 0.0))


def _frames(cloud: Cloud, **options: object) -> object:
    return boxwright.infer_frames([PosedCloud(cloud=cloud, base_from_camera=np.eye(4))], **options)


WAYS: tuple[Callable[..., object], ...] = (boxwright.infer, segment, perceive, _frames)

NO_DIRECTIONS = (
    ((0.0, 0.0, 0.0), "up has length 0; a direction"),
    ((np.nan, 0.0, 1.0), "up holds nan; it must be finite"),
    ((0.0, np.inf, 1.0), "up holds inf; it must be finite"),
    ((0.0, 0.0, 1e300), "up has length 1e"),
    ((0.0, 1.0), "up has 2 values; it must be x, y, z"),
)


@pytest.mark.parametrize("way", WAYS)
def test_up_that_is_no_direction_is_refused(way: Callable[..., object]) -> None:
    cloud = _tray()
    for up, fault in NO_DIRECTIONS:
        with pytest.raises(ValueError, match=fault) as refusal:
            way(cloud, up=up)
        assert "\n" not in str(refusal.value)
    assert len(NO_DIRECTIONS) == 5


def test_directions_and_points_on_the_command_line_are_finite() -> None:
    assert Triple.parse("0,0,0") == (0.0, 0.0, 0.0)
    assert Triple.parse_direction("0,0,-2.5") == (0.0, 0.0, -2.5)
    for text in ("0,0,0", "nan,0,1", "0,inf,1"):
        with pytest.raises(typer.BadParameter):
            Triple.parse_direction(text)
    with pytest.raises(typer.BadParameter, match="'0,0,nan' holds nan; it must be finite"):
        Triple.parse("0,0,nan")


@pytest.mark.parametrize("way", WAYS)
def test_a_front_end_that_is_not_known_is_named_with_those_that_are(way: Callable[..., object]) -> None:
    with pytest.raises(ValueError, match="planes 'grdi' is not known; known are ransac, grid"):
        way(_tray(), planes="grdi")


@pytest.mark.parametrize("way", [boxwright.infer, segment, _frames])
def test_a_region_beside_all_readings_says_where_they_lie(way: Callable[..., object]) -> None:
    cloud = _tray()
    far = (0.0, 0.1, 0.0, 0.1, 8.0, 9.0)
    low, high = cloud.points.min(axis=0), cloud.points.max(axis=0)
    where = ", ".join(f"{axis} {a:.3f} to {b:.3f}" for axis, a, b in zip("xyz", low, high, strict=True))
    with pytest.raises(ValueError, match="holds no reading; the cloud's readings lie in") as refusal:
        way(cloud, roi=far)
    assert f"roi {','.join(map(str, far))}: " in str(refusal.value)
    assert str(refusal.value).endswith(f"lie in {where} m")
    assert str(refusal.value).startswith("frame 1: ") == (way is _frames)


def test_a_region_of_a_cloud_without_readings_is_not_blamed() -> None:
    nothing = Cloud(points=np.full((64, 3), np.nan, np.float32), width=8, height=8, viewpoint=(0.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="no finite readings among 64 points"):
        segment(nothing, roi=(-1.0, 1.0, -1.0, 1.0, 0.0, 2.0))


def test_an_image_of_few_pixels_warns_where_pixels_are_counted() -> None:
    told = 0
    for width, height in ((160, 120), (200, 190), (320, 120), (320, 240)):
        cloud = _tray(width, height)
        is_coarse = width * height < FEWEST_PIXELS
        for warnings in (boxwright.infer(cloud).model.warnings, _frames(cloud).model.warnings):
            lines = [line for line in warnings if f"the image has {width} x {height} pixels" in line]
            assert len(lines) == is_coarse, (width, height)
            assert all("120 readings" in line and "320 x 240" in line for line in lines)
            told += len(lines)
        assert not any("the image has" in line for line in boxwright.infer(cloud, method="exact").model.warnings)
    assert told == 4
