"""Pictures: where a view puts points, and that a figure is made of any answer."""

from __future__ import annotations

from pathlib import Path

import msgspec
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from boxwright.figures import save_frame_figure
from boxwright.figures.graph import draw_graph
from boxwright.figures.view import view_of
from boxwright.models import TEMPLATE_NAMES, load_template
from boxwright.perception import perceive
from boxwright.pipeline import Inferred
from boxwright.simulation import make_frame
from boxwright.types import Cloud, Model
from support.sample_model import sample_model

COVERED_PX = 2.01
"""A dot of a made-up camera reaches so far from its point."""


@pytest.fixture(scope="module")
def cloud() -> Cloud:
    frame = make_frame("small", 3, boxes=1)
    return Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))


def _unorganized(cloud: Cloud) -> Cloud:
    points = np.ascontiguousarray(cloud.points[np.isfinite(cloud.points).all(axis=1)])
    return Cloud(points=points, width=len(points), height=1)


def test_a_camera_image_projects_as_its_camera_does(cloud: Cloud) -> None:
    camera = make_frame("small", 3, boxes=1).truth.camera
    view = view_of(cloud, perceive(cloud))
    assert view.is_camera_image
    points = np.random.default_rng(0).uniform((-0.5, -0.5, 0.8), (0.5, 0.5, 2.0), (100, 3))
    expected = points[:, :2] / points[:, 2:] * (camera.fx, camera.fy) + (camera.cx, camera.cy)
    assert np.abs(view.project(points) - expected).max() < 1.0
    rows, columns = np.nonzero(view.index >= 0)
    assert np.array_equal(view.index[rows, columns], rows * cloud.width + columns)


def test_a_camera_that_looks_backwards_shows_the_same_image(cloud: Cloud) -> None:
    turned = Cloud(points=cloud.points * np.float32([1, -1, -1]), width=cloud.width, height=cloud.height)
    view = view_of(turned, perceive(cloud))
    assert view.is_camera_image
    ahead, behind = np.array([[0.1, 0.2, -1.0]]), np.array([[0.1, 0.2, 1.0]])
    assert view.has_before_it(ahead)
    assert not view.has_before_it(behind)
    same = view_of(cloud, perceive(cloud)).project(ahead * (1, -1, -1))
    assert view.project(ahead) == pytest.approx(same, abs=1e-3)


@pytest.mark.parametrize("viewpoint", [None, (0.0, 0.0, 0.0)])
def test_a_made_up_camera_shows_points_where_it_projects_them(
    cloud: Cloud, viewpoint: tuple[float, float, float] | None
) -> None:
    bare = _unorganized(cloud)
    seen = Cloud(points=bare.points, width=bare.width, height=1, viewpoint=viewpoint)
    view = view_of(seen, perceive(bare))
    assert not view.is_camera_image
    rows, columns = np.nonzero(view.index >= 0)
    pixels = view.project(seen.points[view.index[rows, columns]].astype(np.float64))
    assert np.abs(pixels - np.column_stack([columns, rows])).max() < COVERED_PX
    assert len(rows) > 0.1 * view.index.size


@pytest.mark.parametrize("organized", [True, False])
@pytest.mark.parametrize("with_object", [True, False])
def test_a_figure_is_drawn_and_is_the_same_again(
    cloud: Cloud, organized: bool, with_object: bool, tmp_path: Path
) -> None:
    shown = cloud if organized else _unorganized(cloud)
    perception = perceive(shown)
    content = sample_model()
    model = msgspec.convert(content if with_object else content | {"objects": []}, type=Model)
    nothing = np.full(len(shown.points), -1, np.int16)
    inferred = Inferred(model, nothing, nothing, perception, np.zeros((0, 0)))
    contents = []
    for name in ("a.png", "b.png"):
        save_frame_figure(shown, inferred, tmp_path / name)
        contents.append((tmp_path / name).read_bytes())
    assert contents[0] == contents[1]
    assert contents[0].startswith(b"\x89PNG")


@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_a_graph_has_a_node_for_each_part_and_a_line_for_each_tie(name: str) -> None:
    axes = Figure().add_subplot()
    template = load_template(name)
    draw_graph(axes, template, None, (0.0, 0.0), 1.0)
    nodes = [patch for patch in axes.patches if isinstance(patch, Circle)]
    centres = {tuple(np.round(node.get_center(), 9)) for node in nodes}
    assert len(nodes) == len(centres) == len(template.parts)
    assert len(axes.patches) - len(nodes) == len(template.edges)
