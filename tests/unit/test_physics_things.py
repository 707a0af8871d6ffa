"""What else stands around, in physics: it does not move, it stops what comes to it, and touching it is told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from boxwright.planning import read_scene
from boxwright.simulation.physics import Load, Session, crease_class, simulate_closing, true_box
from support.finger import Finger, push_shut
from support.true_boxes import carton, truth_of

BOX = true_box(truth_of(carton()), 0, np.eye(4))
SEGMENTS = push_shut(BOX, "flap_1", 0.0)


def _thing(name: str, centre_m: tuple[float, float, float], size_m: tuple[float, float, float]) -> dict[str, Any]:
    return {"name": name, "centre_m": list(centre_m), "rotation": np.eye(3).tolist(), "size_m": list(size_m)}


def test_a_thing_in_the_tool_s_way_is_touched_and_told() -> None:
    x, y, z = SEGMENTS[0].positions[1]
    on_the_way = _thing("flap_1", (x, y, z + 0.02), (0.02, 0.02, 0.02))
    told = simulate_closing(BOX, Finger(), SEGMENTS, load=Load(mass_kg=4.0), scene=[on_the_way]).simulation
    assert ("finger", "scene_flap_1") in told.unwanted
    free = simulate_closing(BOX, Finger(), SEGMENTS, load=Load(mass_kg=4.0)).simulation
    assert not free.unwanted


def test_a_light_box_that_slides_is_held_by_what_stands_behind_it() -> None:
    slid_m = []
    reach_m = np.concatenate([board.corners for board in BOX.fixed])[:, 0].max() + BOX.thickness_m / 2.0
    walls = [_thing("wall", (side * (reach_m + 0.011), 0.0, 0.05), (0.02, 0.4, 0.1)) for side in (1.0, -1.0)]
    for scene in ((), walls):
        run = simulate_closing(BOX, Finger(), SEGMENTS, "stiff", load=Load(empty=True), scene=scene)
        assert run.simulation.failure is None
        slid_m.append(run.simulation.box_slid_m)
    assert slid_m[0] > 0.02
    assert slid_m[1] < 0.005


def test_things_stand_where_the_scene_s_file_tells_and_do_not_move(tmp_path: Path) -> None:
    path = tmp_path / "scene.urdf"
    path.write_text(
        '<robot name="s"><link name="fence">'
        '<collision><origin xyz="0.5 0.4 0.3" rpy="0.1 0.2 0.3"/><geometry><box size="0.1 0.2 0.3"/></geometry>'
        "</collision>"
        '<collision><origin xyz="0.5 -0.4 0.3"/><geometry><sphere radius="0.1"/></geometry></collision>'
        "</link></robot>",
        encoding="utf-8",
    )
    things = read_scene(path)
    start = np.array(SEGMENTS[0].positions[0])
    session = Session(BOX, Finger(), start, crease_class("ordinary"), scene=things)
    session.follow(SEGMENTS[:1])
    world, data = session.stage.world, session.stage.data
    body = world.model.body("scene_fence")
    assert body.geomnum[0] == len(things) == 2
    for k, thing in zip(range(body.geomadr[0], body.geomadr[0] + 2), things, strict=True):
        np.testing.assert_allclose(data.geom_xpos[k], thing["centre_m"], atol=1e-9)
        np.testing.assert_allclose(data.geom_xmat[k].reshape(3, 3), thing["rotation"], atol=1e-9)
        np.testing.assert_allclose(2.0 * world.model.geom_size[k], thing["size_m"])


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"size_m": [0.1, float("inf"), 0.1]}, "size_m"),
        ({"size_m": [0.1, 0.1]}, "size_m"),
        ({"centre_m": [float("nan"), 0.0, 0.0]}, "nan"),
        ({"rotation": np.diag([1.0, 1.0, 2.0]).tolist()}, "rotation"),
    ],
)
def test_a_thing_that_is_none_is_refused_by_name(change: dict[str, Any], said: str) -> None:
    thing = _thing("fence", (1.0, 0.0, 0.0), (0.1, 0.1, 0.1)) | change
    with pytest.raises(ValueError, match=rf"scene: fence: .*{said}"):
        simulate_closing(BOX, Finger(), SEGMENTS, scene=[thing])
