"""An object as SDFormat 1.9, for Gazebo: a link for each panel, hinges as revolute joints.

Joint positions mean what they mean in model.json. In SDF a joint is at 0 where its links stand as written: the flaps
are written closed, and the measured positions stand in a comment (`configuration` gives them to set).
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from os import PathLike
from pathlib import Path

import numpy as np

from boxwright.kinematics.forward import configuration
from boxwright.kinematics.links import parent_from_joint
from boxwright.kinematics.solids import SolidLink, Solids, numbers, solids_of
from boxwright.kinematics.transforms import Matrix, roll_pitch_yaw
from boxwright.types import Joint, Object
from boxwright.types.board import BOARD_G_PER_M2, BOARD_THICKNESS_M

VERSION = "1.9"


def save_sdf(
    model_object: Object,
    path: str | PathLike[str],
    *,
    root: str | None = None,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> None:
    """Write an object as SDF; equal objects give equal bytes. Arguments and errors are `sdf_text`'s, and OSError."""
    text = sdf_text(model_object, root=root, board_g_per_m2=board_g_per_m2, board_thickness_m=board_thickness_m)
    Path(path).write_text(text, encoding="utf-8")


def sdf_text(
    model_object: Object,
    *,
    root: str | None = None,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> str:
    """An object's SDF: metres, radians, kilograms; the model's frame is the input's.

    Links, root, masses and boxes are those of the URDF (`urdf_text`). Raises ValueError when no part can be the root or
    a panel has no area.
    """
    solids = solids_of(model_object, root, board_g_per_m2, board_thickness_m)
    positions = ", ".join(f"{name} {position!r}" for name, position in configuration(model_object).items())
    sdf = ET.Element("sdf", version=VERSION)
    model = ET.SubElement(sdf, "model", name=model_object.template, canonical_link=solids.root)
    model.append(
        ET.Comment(
            " Made by boxwright. Joint position 0 is a closed flap; it grows as the flap opens."
            f" Measured positions, rad: {positions or 'no joint'}. "
        )
    )
    input_from_link = {name: _closed(solids, name) for name in solids.links}
    for name, link in solids.links.items():
        model.append(_link(link, input_from_link[name]))
    for name in solids.links:
        if name in solids.joint_of:
            model.append(_hinge(solids.joint_of[name]))
        elif name != solids.root:
            model.append(_tie(f"{solids.root}_to_{name}", "fixed", solids.root, name))
    ET.indent(sdf)
    return '<?xml version="1.0"?>\n' + ET.tostring(sdf, encoding="unicode") + "\n"


def _closed(solids: Solids, name: str) -> Matrix:
    """input_from_link with every joint at 0."""
    frames = solids.frames()
    if name not in solids.joint_of:
        return frames[name]
    joint = solids.joint_of[name]
    return _closed(solids, joint.parent) @ parent_from_joint(joint, frames)


def _link(link: SolidLink, input_from_link: Matrix) -> ET.Element:
    element = ET.Element("link", name=link.name)
    _pose(element, input_from_link)
    inertial = ET.SubElement(element, "inertial")
    ET.SubElement(inertial, "pose").text = f"{numbers(link.body.centre)} 0 0 0"
    ET.SubElement(inertial, "mass").text = repr(link.body.mass_kg)
    inertia = ET.SubElement(inertial, "inertia")
    for i in range(3):
        for j in range(i, 3):
            ET.SubElement(inertia, f"i{'xyz'[i]}{'xyz'[j]}").text = repr(float(link.body.inertia[i, j]))
    for kind in ("visual", "collision"):
        shape = ET.SubElement(element, kind, name=f"{link.name}_{kind}")
        _pose(shape, link.link_from_box)
        box = ET.SubElement(ET.SubElement(shape, "geometry"), "box")
        ET.SubElement(box, "size").text = numbers(link.box.size)
    return element


def _hinge(joint: Joint) -> ET.Element:
    element = _tie(joint.name, "revolute", joint.parent, joint.child)
    axis = ET.SubElement(element, "axis")
    ET.SubElement(axis, "xyz").text = "1 0 0"
    limit = ET.SubElement(axis, "limit")
    ET.SubElement(limit, "lower").text = repr(joint.limits[0])
    ET.SubElement(limit, "upper").text = repr(joint.limits[1])
    return element


def _tie(name: str, kind: str, parent: str, child: str) -> ET.Element:
    """A joint stands in its child's frame unless it is told otherwise."""
    element = ET.Element("joint", name=name, type=kind)
    ET.SubElement(element, "parent").text = parent
    ET.SubElement(element, "child").text = child
    return element


def _pose(element: ET.Element, transform: Matrix) -> None:
    turn = roll_pitch_yaw(np.ascontiguousarray(transform[:3, :3]))
    ET.SubElement(element, "pose").text = f"{numbers(transform[:3, 3])} {numbers(turn)}"
