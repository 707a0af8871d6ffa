"""An object as MJCF, MuJoCo's own format: a body for each panel, hinges that stand where they were measured.

Joint positions mean what they mean in model.json, 0 is closed. Unlike URDF, MJCF has a place for the measured
configuration: it is where the model starts (`ref`), and a key frame `closed` has every flap at 0.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from os import PathLike
from pathlib import Path

from boxwright.kinematics.solids import SolidLink, Solids, numbers, solids_of
from boxwright.kinematics.transforms import Matrix, inverse, quaternion_wxyz
from boxwright.types import Object
from boxwright.types.board import BOARD_G_PER_M2, BOARD_THICKNESS_M

CARDBOARD_RGBA = "0.76 0.6 0.42 1"


def save_mjcf(
    model_object: Object,
    path: str | PathLike[str],
    *,
    root: str | None = None,
    free: bool = False,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> None:
    """Write an object as MJCF; equal objects give equal bytes. Arguments and errors are `mjcf_text`'s, and OSError."""
    text = mjcf_text(
        model_object, root=root, free=free, board_g_per_m2=board_g_per_m2, board_thickness_m=board_thickness_m
    )
    Path(path).write_text(text, encoding="utf-8")


def mjcf_text(
    model_object: Object,
    *,
    root: str | None = None,
    free: bool = False,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> str:
    """An object's MJCF: metres, radians, kilograms; the world's frame is the input's.

    Links, root, masses and boxes are those of the URDF (`urdf_text`); `free` lets the root move. A flap and what it
    hangs on do not collide. Raises ValueError when no part can be the root, or a panel has no area.
    """
    solids = solids_of(model_object, root, board_g_per_m2, board_thickness_m)
    mujoco = ET.Element("mujoco", model=model_object.template)
    mujoco.append(ET.Comment(" Made by boxwright. Joint position 0 is a closed flap; it grows as the flap opens. "))
    ET.SubElement(mujoco, "compiler", angle="radian", fusestatic="false")
    bodies = _bodies(solids, free=free)
    ET.SubElement(mujoco, "worldbody").append(bodies[solids.root])
    contact = ET.SubElement(mujoco, "contact")
    for name, joint in solids.joint_of.items():
        ET.SubElement(contact, "exclude", body1=joint.parent, body2=name)
    if solids.joint_of and not free:
        closed = " ".join("0" for _ in solids.joint_of)
        ET.SubElement(ET.SubElement(mujoco, "keyframe"), "key", name="closed", qpos=closed)
    ET.indent(mujoco)
    return '<?xml version="1.0"?>\n' + ET.tostring(mujoco, encoding="unicode") + "\n"


def _bodies(solids: Solids, *, free: bool) -> dict[str, ET.Element]:
    """Every link's body, hung on its parent's: the hinge's, or the root's where it is fixed."""
    frames = solids.frames()
    bodies = {}
    for name, link in solids.links.items():
        joint = solids.joint_of.get(name)
        parent = joint.parent if joint is not None else solids.root
        here = frames[name] if name == solids.root else inverse(frames[parent]) @ frames[name]
        body = ET.Element("body", name=name, pos=numbers(here[:3, 3]), quat=numbers(quaternion_wxyz(here)))
        if name == solids.root and free:
            ET.SubElement(body, "freejoint", name=f"{name}_free")
        if joint is not None:
            ET.SubElement(
                body,
                "joint",
                name=joint.name,
                type="hinge",
                axis="1 0 0",
                ref=repr(joint.position),
                limited="true",
                range=numbers(joint.limits),
            )
        _fill(body, link)
        bodies[name] = body
    for name in bodies:
        if name != solids.root:
            joint = solids.joint_of.get(name)
            bodies[joint.parent if joint is not None else solids.root].append(bodies[name])
    return bodies


def _fill(body: ET.Element, link: SolidLink) -> None:
    inertia = link.body.inertia
    ET.SubElement(
        body,
        "inertial",
        pos=numbers(link.body.centre),
        mass=repr(link.body.mass_kg),
        fullinertia=numbers(_six(inertia)),
    )
    here = link.link_from_box
    ET.SubElement(
        body,
        "geom",
        name=link.name,
        type="box",
        pos=numbers(here[:3, 3]),
        quat=numbers(quaternion_wxyz(here)),
        size=numbers(link.box.size / 2.0),
        rgba=CARDBOARD_RGBA,
    )


def _six(inertia: Matrix) -> tuple[float, ...]:
    """xx, yy, zz, xy, xz, yz, as MJCF wants them."""
    return tuple(float(inertia[i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
