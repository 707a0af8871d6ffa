"""A box of boards as MuJoCo bodies: one free body of base and sides, flaps on elasto-plastic hinges."""

from __future__ import annotations

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.physics.boards import Board, BoardBox, Hinge
from boxwright.simulation.physics.creases import Crease
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.sheets import Sheet, Touches, sheets_of
from boxwright.simulation.physics.slabs import Slab, Trim, area_m2, panel_axes, slabs_of
from boxwright.simulation.poses import apply, inverse

Array = NDArray[np.float64]

FLAP_RANGE_RAD = (-np.pi / 2.0, 1.5 * np.pi)
TUCK_RANGE_RAD = (-np.pi / 2.0, np.pi)
"""What docs/formats.md allows; boards and support stop a flap before."""

BOARD_RGBA = (0.76, 0.60, 0.42, 1.0)
FLAP_RGBA = (0.85, 0.70, 0.50, 1.0)
CONTENTS_RGBA = (0.5, 0.5, 0.55, 1.0)
HIDDEN_GROUP = 4
"""MuJoCo's viewers leave out geoms of this group unless they are asked for."""
GRAMS_PER_KILOGRAM = 1000.0
CONTENTS_SHARE = 0.5
"""Contents fill this much of the height, as a block that nothing touches."""


SOLID = Touches(1, 1)
FLAP = Touches(2, 1)
"""Flaps meet all that is solid as the boards that they are, and one another as sheets (sheets.py)."""


class BoxNames(msgspec.Struct, frozen=True):
    """Bodies of a box in a scene: that of base and sides, every board's by its name, and the joints of the hinges.

    A second box's are told apart by a prefix.
    """

    root: str
    body_of: dict[str, str]
    joint_of: dict[str, str]


def add_box(
    spec: mujoco.MjSpec,
    box: BoardBox,
    crease: Crease,
    settings: PhysicsSettings,
    *,
    prefix: str = "",
    free: bool = True,
    contents_kg: float = 0.0,
) -> BoxNames:
    """Puts a box into a scene, free to move, or nailed down with its flaps where they are.

    Hinge positions mean what they mean in docs/formats.md. `standing_state` sets the creases' rest angles.
    """
    root = spec.worldbody.add_body(name=f"{prefix}box", pos=box.world_from_box[:3, 3], quat=_quat(box.world_from_box))
    if free:
        root.add_freejoint(name=f"{prefix}box")
    bodies: dict[str, mujoco.MjsBody] = {}
    for board in box.boards:
        bodies[board.name] = _add_board(bodies, root, box, board, settings, prefix)
    joints = {}
    for board, hinge in box.hinged:
        if free:
            joints[board.name] = _add_hinge(
                bodies[board.name], prefix + board.name, board, hinge, crease, box.thickness_m, settings
            )
            for sheet in sheets_of(box, board, settings):
                _add_sheet(bodies[board.name], board, sheet, settings, prefix)
        spec.add_exclude(bodyname1=prefix + hinge.parent, bodyname2=prefix + board.name)
    if contents_kg > 0.0:
        _add_contents(root, box, contents_kg, prefix)
    return BoxNames(f"{prefix}box", {name: prefix + name for name in bodies}, joints)


def empty_mass_kg(box: BoardBox, settings: PhysicsSettings) -> float:
    """What the boards weigh."""
    return sum(_mass_kg(board, settings) for board in box.boards)


def _add_board(
    bodies: dict[str, mujoco.MjsBody],
    root: mujoco.MjsBody,
    box: BoardBox,
    board: Board,
    settings: PhysicsSettings,
    prefix: str,
) -> mujoco.MjsBody:
    """A body for each board, in the panel's frame; fixed ones are welded to the root, so never touch each other."""
    parent = root if board.hinge is None else bodies[board.hinge.parent]
    parent_frame = box.world_from_box if board.hinge is None else board_frame(box.board(board.hinge.parent))
    world_from_board = board_frame(board)
    here = inverse(parent_frame) @ world_from_board
    body = parent.add_body(name=prefix + board.name, pos=here[:3, 3], quat=_quat(here))
    # A racked base is one rectangle: four corners are what it stands on.
    slabs = slabs_of(board.corners, box.thickness_m, _trim(board, box), taper=board.name != "base")
    total_m2 = sum(4.0 * slab.half_m[0] * slab.half_m[1] for slab in slabs)
    for slab in slabs:
        share = 4.0 * slab.half_m[0] * slab.half_m[1] / total_m2
        rgba, touches = (BOARD_RGBA, SOLID) if board.hinge is None else (FLAP_RGBA, FLAP)
        _add_slab(body, world_from_board, slab, share * _mass_kg(board, settings), touches, settings, rgba)
    return body


def _trim(board: Board, box: BoardBox) -> Trim:
    """Sides end half a board before rim and corners: what is folded there turns about the middle of its board.

    They start on the base, which alone stands on the support: a box that stands on five boards at once rests no better.
    """
    half = box.thickness_m / 2.0
    if board.name.startswith("side"):
        return Trim(near_m=half, far_m=half, ends_m=half)
    return Trim()


def board_frame(board: Board) -> Array:
    """world_from_board as the board was told: origin in the middle of its first edge, x along it, y in the panel."""
    frame = np.eye(4)
    frame[:3, :3] = panel_axes(board.corners)
    frame[:3, 3] = (board.corners[0] + board.corners[1]) / 2.0
    return frame


def _add_slab(
    body: mujoco.MjsBody,
    world_from_board: Array,
    slab: Slab,
    mass_kg: float,
    touches: Touches,
    settings: PhysicsSettings,
    rgba: tuple[float, float, float, float],
) -> None:
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        **_place(world_from_board, slab),
        size=slab.half_m,
        mass=mass_kg,
        rgba=rgba,
        **touches.as_geom(),
        **contact_of(settings, settings.friction_board),
    )


def _add_sheet(body: mujoco.MjsBody, board: Board, sheet: Sheet, settings: PhysicsSettings, prefix: str) -> None:
    body.add_geom(
        name=f"{prefix}{board.name}_{sheet.name}",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        **_place(board_frame(board), sheet.slab),
        size=sheet.slab.half_m,
        mass=0.0,
        group=HIDDEN_GROUP,
        **sheet.touches.as_geom(),
        **contact_of(settings, settings.sheet_friction),
    )


def _place(world_from_board: Array, slab: Slab) -> dict[str, Array]:
    """Where a slab is in its board's frame, as a geom's attributes."""
    world_from_slab = np.eye(4)
    world_from_slab[:3, :3], world_from_slab[:3, 3] = slab.axes, slab.centre
    board_from_slab = inverse(world_from_board) @ world_from_slab
    return {"pos": board_from_slab[:3, 3], "quat": _quat(board_from_slab)}


def contact_of(settings: PhysicsSettings, friction: float) -> dict[str, object]:
    """Contact parameters of a geom: how stiff, and how rough."""
    impedance = settings.contact_impedance
    return {
        "friction": [friction, 0.0, 0.0],
        "condim": 3,
        "solref": [settings.contact_time_s, 1.0],
        "solimp": [impedance, impedance, 0.001, 0.5, 2.0],
    }


def _add_hinge(
    body: mujoco.MjsBody,
    name: str,
    board: Board,
    hinge: Hinge,
    crease: Crease,
    thickness_m: float,
    settings: PhysicsSettings,
) -> str:
    """The body stands where the board was measured, which is the joint's measured position."""
    board_from_world = inverse(board_frame(board))
    reach_m = float(np.linalg.norm(board.corners[2:].mean(axis=0) - hinge.origin))
    stiffness = crease.stiffness_n_m_per_rad(hinge.length_m, thickness_m)
    low, high = TUCK_RANGE_RAD if board.name.startswith("tuck") else FLAP_RANGE_RAD
    body.add_joint(
        name=name,
        type=mujoco.mjtJoint.mjJNT_HINGE,
        pos=apply(board_from_world, hinge.origin),
        axis=board_from_world[:3, :3] @ hinge.axis,
        ref=hinge.position_rad,
        limited=mujoco.mjtLimited.mjLIMITED_TRUE,
        range=[min(low, hinge.position_rad), max(high, hinge.position_rad)],
        armature=settings.edge_kg * reach_m**2,
        damping=settings.crease_relaxation_s * stiffness,
        stiffness=stiffness,
        springref=hinge.position_rad,
        springyield=crease.return_rad,
    )
    return name


def contents_volume_m3(box: BoardBox) -> float:
    """What a box holds."""
    length_m, width_m, height_m = _inner_m(box)
    return length_m * width_m * height_m


def _inner_m(box: BoardBox) -> tuple[float, float, float]:
    base = box.board("base").corners
    length_m, width_m = (float(np.linalg.norm(base[k + 1] - base[k])) - box.thickness_m for k in (0, 1))
    heights = [side.corners for side in box.fixed if side.name.startswith("side")]
    return length_m, width_m, float(np.linalg.norm(heights[0][0] - heights[0][3]))


def _add_contents(root: mujoco.MjsBody, box: BoardBox, contents_kg: float, prefix: str) -> None:
    """A block on the base that fills the lower part of the box and is there for its weight alone."""
    length_m, width_m, height_m = _inner_m(box)
    half_m = np.array([length_m, width_m, CONTENTS_SHARE * height_m]) / 2.0
    root.add_geom(
        name=f"{prefix}contents",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[0.0, 0.0, box.thickness_m + half_m[2]],
        size=0.98 * half_m,
        mass=contents_kg,
        contype=0,
        conaffinity=0,
        rgba=CONTENTS_RGBA,
    )


def _mass_kg(board: Board, settings: PhysicsSettings) -> float:
    return area_m2(board.corners) * settings.board_g_per_m2 / GRAMS_PER_KILOGRAM


def _quat(frame: Array) -> Array:
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, np.ascontiguousarray(frame[:3, :3]).reshape(9))
    return quat
