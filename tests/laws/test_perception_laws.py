"""What must hold of perception whatever the scene: equal bits, no dependence on the frame, up at any tilt and roll."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from boxwright import perception
from boxwright.io.clouds import read_cloud
from boxwright.io.truth import load_truth
from boxwright.perception import Perception
from boxwright.types import Cloud

WIDTH, HEIGHT, FOCAL_PX = 320, 240, 290.0
both_ways = pytest.mark.parametrize("planes", ["ransac", "grid"])
Quad = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Corner and the two edges from it."""


def perceive(cloud: Cloud, planes: str = "ransac") -> Perception:
    """The paper's front end where nothing else is said: the others' laws have files of their own."""
    return perception.perceive(cloud, planes=planes)


def box_quads(center: tuple[float, float], size: tuple[float, float, float], yaw: float) -> list[Quad]:
    """Four walls and a base, 4 mm over z = 0, of an open box."""
    length, width, height = size
    turn = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, 1]])
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * [length / 2, width / 2, 0]
    corners = corners @ turn.T + [*center, 0.004]
    rise = np.array([0, 0, height])
    walls = [(corners[k], corners[(k + 1) % 4] - corners[k], rise) for k in range(4)]
    return [*walls, (corners[0], corners[1] - corners[0], corners[3] - corners[0])]


def look_at(distance: float, tilt: float, azimuth: float, roll: float) -> tuple[np.ndarray, np.ndarray]:
    """camera_from_world rotation and the camera's place; `tilt` is the angle below the horizon."""
    away = np.array([np.cos(tilt) * np.cos(azimuth), np.cos(tilt) * np.sin(azimuth), np.sin(tilt)])
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    down = np.cross(-away, right)
    right, down = np.cos(roll) * right + np.sin(roll) * down, np.cos(roll) * down - np.sin(roll) * right
    return np.array([right, down, -away]), away * distance


def render(quads: list[Quad], rotation: np.ndarray, eye: np.ndarray, rng: np.random.Generator) -> Cloud:
    """Organized cloud in the optical frame, with noise that grows with the square of the depth."""
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    rays = np.stack([(u - WIDTH / 2) / FOCAL_PX, (v - HEIGHT / 2) / FOCAL_PX, np.ones_like(u, float)], -1).reshape(
        -1, 3
    )
    depth = np.full(len(rays), np.inf)
    for corner, a, b in quads:
        corner, a, b = rotation @ (corner - eye), rotation @ a, rotation @ b
        normal = np.cross(a, b)
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (normal @ corner) / (rays @ normal)
            hit = rays * t[:, None] - corner
            s, r = (hit @ a) / (a @ a), (hit @ b) / (b @ b)
            inside = (t > 0.1) & (s >= 0) & (s <= 1) & (r >= 0) & (r <= 1) & (t < depth)
        depth = np.where(inside, t, depth)
    depth[depth > 4.5] = np.nan
    depth += 0.0016 * depth**2 * rng.normal(size=len(depth))
    points = np.ascontiguousarray(rays * depth[:, None], dtype=np.float32)
    return Cloud(points=points, width=WIDTH, height=HEIGHT, viewpoint=(0.0, 0.0, 0.0))


def plate(low: tuple[float, float], high: tuple[float, float], z: float) -> Quad:
    """A level rectangle at height z."""
    size = np.subtract(high, low)
    return np.array([*low, z]), np.array([size[0], 0, 0]), np.array([0, size[1], 0])


def up_error_deg(seen_up: np.ndarray, true_up: np.ndarray) -> float:
    """Angle between two unit vectors."""
    return float(np.degrees(np.arccos(np.clip(seen_up @ true_up, -1, 1))))


@both_ways
def test_up_and_floor_at_any_tilt_and_roll(planes: str) -> None:
    rng = np.random.default_rng(2011)
    quads = [plate((-3, -3), (3, 3), 0.0), *box_quads((0, 0), (0.4, 0.3, 0.25), 0.4)]
    cases = 0
    for tilt_deg in (25, 45, 65, 80, 90):
        rolls = (-180, -135, -90, -45, 0, 45, 90, 135) if tilt_deg >= 80 else (-60, -30, 0, 30, 60)
        for roll_deg in rolls:
            rotation, eye = look_at(1.3, np.radians(tilt_deg), rng.uniform(0, 6.28), np.radians(roll_deg))
            seen = perceive(render(quads, rotation, eye, rng), planes)
            assert up_error_deg(seen.up, rotation[:, 2]) < 1.0, (tilt_deg, roll_deg)
            assert seen.support_plane is not None
            assert seen.support_plane[1] == pytest.approx(-eye[2], abs=0.01), (tilt_deg, roll_deg)
            cases += 1
    assert cases == 31


@both_ways
def test_a_table_before_the_floor_below_it_and_a_wall_behind(planes: str) -> None:
    rng = np.random.default_rng(5)
    wall = (np.array([-3.0, 1.2, -0.75]), np.array([6.0, 0, 0]), np.array([0, 0, 3.0]))
    room = [plate((-3, -3), (3, 1.2), -0.75), wall, plate((-0.6, -0.4), (0.6, 0.4), 0.0)]
    cases = 0
    for tilt_deg in (30, 45, 60):
        for yaw in (0.0, 0.5):
            quads = [*room, *box_quads((0.1, 0), (0.3, 0.25, 0.2), yaw)]
            rotation, eye = look_at(1.4, np.radians(tilt_deg), -np.pi / 2 + 0.2, 0.0)
            seen = perceive(render(quads, rotation, eye, rng), planes)
            assert up_error_deg(seen.up, rotation[:, 2]) < 1.0, (tilt_deg, yaw)
            assert seen.support_plane is not None
            assert seen.support_plane[1] == pytest.approx(-eye[2], abs=0.01), (tilt_deg, yaw)
            cases += 1
    assert cases == 6


@both_ways
def test_normals_look_at_the_viewpoint_and_one_box_is_one_group(planes: str) -> None:
    rng = np.random.default_rng(6)
    rotation, eye = look_at(1.2, np.radians(50), 0.7, 0.0)
    quads = [plate((-2, -2), (2, 2), 0.0), *box_quads((0, 0), (0.4, 0.3, 0.2), 0.2)]
    seen = perceive(render(quads, rotation, eye, rng), planes)
    assert np.all(seen.distances < 0)
    box = seen.groups == 0
    assert set(seen.groups) <= {0, -1}
    assert np.sum(box) == 5
    walls = np.abs(seen.normals[box] @ rotation[:, 2]) < 0.1
    assert (np.sum(walls), np.sum(~walls)) == (4, 1)


@both_ways
def test_two_boxes_apart_are_two_groups_with_a_base_each(planes: str) -> None:
    rng = np.random.default_rng(7)
    rotation, eye = look_at(1.3, np.radians(65), 0.3, 0.0)
    boxes = [*box_quads((-0.25, 0), (0.3, 0.25, 0.15), 0.0), *box_quads((0.25, 0), (0.3, 0.25, 0.15), 0.3)]
    seen = perceive(render([plate((-2, -2), (2, 2), 0.0), *boxes], rotation, eye, rng), planes)
    level = (np.abs(seen.normals @ rotation[:, 2]) > 0.98) & (seen.groups >= 0)
    assert sorted(seen.groups[level]) == [0, 1]


def test_answers_move_with_the_cloud() -> None:
    rng = np.random.default_rng(8)
    rotation, eye = look_at(1.2, np.radians(55), 1.0, 0.0)
    quads = [plate((-1.5, -1.5), (1.5, 1.5), 0.0), *box_quads((0, 0), (0.4, 0.3, 0.2), 0.2)]
    seen_in_camera = render(quads, rotation, eye, rng).points
    still = seen_in_camera[np.isfinite(seen_in_camera).all(1)].astype(float)
    sizes = []
    for k in range(4):
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        turn *= np.sign(np.linalg.det(turn))
        turn, shift = (np.eye(3), np.zeros(3)) if k == 0 else (turn, rng.normal(size=3))
        points = np.ascontiguousarray(still @ turn.T + shift, dtype=np.float32)
        seen = perceive(Cloud(points=points, width=len(points), height=1, viewpoint=tuple(shift)))
        assert up_error_deg(seen.up, turn @ rotation[:, 2]) < 0.5
        edges = np.linalg.norm(np.diff(seen.rectangles[:, :3], axis=1), axis=2)
        large = np.sort(np.prod(edges, axis=1))[-5:]
        sizes.append(large)
    assert len(sizes) == 4
    assert np.ptp(np.array(sizes), axis=0) == pytest.approx(np.zeros(5), abs=0.006)


PRINT_BITS = """
import hashlib, sys, numpy as np
from boxwright import _core
points = np.load(sys.argv[1])
seen = _core.perceive(points, 320, 240, (0.0, 0.0, 0.0))
parts = [seen.up, seen.normals, seen.distances, seen.rectangles, seen.rms, seen.groups, seen.labels, *seen.hulls]
print(hashlib.sha256(b"".join(np.ascontiguousarray(p).tobytes() for p in parts)).hexdigest())
"""


def test_equal_bits_every_run_and_any_thread_count(tmp_path: Path) -> None:
    rng = np.random.default_rng(9)
    rotation, eye = look_at(1.3, np.radians(60), 0.3, 0.0)
    boxes = [*box_quads((-0.25, 0), (0.3, 0.25, 0.15), 0.0), *box_quads((0.25, 0), (0.3, 0.25, 0.15), 0.3)]
    np.save(tmp_path / "points.npy", render([plate((-2, -2), (2, 2), 0.0), *boxes], rotation, eye, rng).points)

    def bits(threads: int) -> str:
        command = [sys.executable, "-c", PRINT_BITS, str(tmp_path / "points.npy")]
        env = {**os.environ, "RAYON_NUM_THREADS": str(threads)}
        return subprocess.run(command, check=True, capture_output=True, text=True, env=env).stdout

    answers = [bits(threads) for threads in (1, 2, 4, 1)]
    assert len(answers[0]) > 60
    assert set(answers) == {answers[0]}


def test_ten_million_points_have_labels() -> None:
    rng = np.random.default_rng(10)
    n = 10_000_000
    points = rng.uniform([-2, -2, 0], [2, 2, 0.0], (n, 3)).astype(np.float32)
    points[: n // 5] = rng.uniform([-0.2, -0.2, 0.0], [0.2, 0.2, 0.3], (n // 5, 3))
    points[: n // 5, 0] = np.where(rng.random(n // 5) < 0.5, -0.2, 0.2)
    points += rng.normal(0, 0.001, points.shape).astype(np.float32)
    start = time.perf_counter()
    seen = perceive(Cloud(points=points, width=n, height=1))
    assert time.perf_counter() - start < 60
    assert seen.labels.shape == (n,)
    assert up_error_deg(seen.up, np.array([0.0, 0.0, 1.0])) < 0.2
    assert np.count_nonzero(seen.point_counts > n // 20) == 2


@both_ways
def test_up_and_support_of_the_labelled_frames(planes: str, shared_dir: Path) -> None:
    cases = 0
    for path in sorted((shared_dir / "data" / "labelled").glob("*.truth.json")):
        truth = load_truth(path)
        seen = perceive(read_cloud(path.with_name(f"{truth.name}.pcd")), planes)
        assert up_error_deg(seen.up, np.array(truth.up)) < 1.5, truth.name
        assert seen.support_plane is not None, truth.name
        normal, distance = seen.support_plane
        lowest_m = [np.min(np.array(p.corners) @ normal) - distance for p in truth.parts if p.name == "base"]
        assert np.abs(lowest_m) == pytest.approx(np.zeros(len(lowest_m)), abs=0.012), truth.name
        cases += 1
    assert cases == 14


def test_up_of_the_real_clouds(shared_dir: Path) -> None:
    real = shared_dir / "data" / "real"
    bare = perceive(read_cloud(real / "box_on_floor_luxonis" / "calibration_camframe.pcd"))
    assert (len(bare), bare.support_plane is not None) == (0, True)
    tote = perceive(read_cloud(real / "tote_apc" / "tote_fused_model.pcd"))
    assert tote.support_plane is None
    assert up_error_deg(tote.up, np.array([0.0, 0.0, 1.0])) < 5
    table = perceive(read_cloud(real / "table_ros_industrial" / "table.pcd"))
    assert table.support_plane is not None
    assert up_error_deg(table.up, np.array([0.0, 0.0, 1.0])) < 3
    for name in ("learn0", "learn12"):
        cloud = read_cloud(real / "boxes_on_table_osd" / f"{name}.pcd")
        seen = perceive(cloud)
        assert seen.support_plane is not None
        normal, distance = seen.support_plane
        assert cloud.labels is not None
        on_table = cloud.points[(cloud.labels >= 1) & (cloud.labels <= 9)].astype(float) @ normal - distance
        assert np.median(np.abs(on_table)) < 0.01
    assert perceive(read_cloud(real / "tote_apc" / "shelf_bin_frame00.pcd")).labels.shape == (307200,)
