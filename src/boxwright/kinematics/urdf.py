"""An object as URDF: a link for each panel, hinges as revolute joints with limits, no meshes (docs/formats.md).

Joint positions mean what they mean in model.json: 0 is closed. URDF has no place for a measured configuration; it
stands in a comment at the top, and `configuration` gives it to set in a simulator or to publish as joint states.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from os import PathLike
from pathlib import Path

from boxwright.kinematics.forward import configuration
from boxwright.kinematics.links import parent_from_joint
from boxwright.kinematics.plates import EnclosingBox, Plate
from boxwright.kinematics.solids import SolidLink, Solids, numbers, solids_of
from boxwright.kinematics.transforms import Matrix, inverse, roll_pitch_yaw
from boxwright.types import Joint, Object
from boxwright.types.board import BOARD_G_PER_M2, BOARD_THICKNESS_M

HINGE_EFFORT_N_M = 10.0
HINGE_VELOCITY_RAD_PER_S = 6.283185307179586
"""URDF asks every revolute joint for an effort and a velocity. Nothing drives a cardboard hinge: wide bounds."""

CARDBOARD_RGBA = "0.76 0.6 0.42 1"


def save_urdf(
    model_object: Object,
    path: str | PathLike[str],
    *,
    root: str | None = None,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> None:
    """Write an object as URDF; equal objects give equal bytes. Arguments and errors are `urdf_text`'s, and OSError."""
    text = urdf_text(model_object, root=root, board_g_per_m2=board_g_per_m2, board_thickness_m=board_thickness_m)
    Path(path).write_text(text, encoding="utf-8")


def urdf_text(
    model_object: Object,
    *,
    root: str | None = None,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> str:
    """An object's URDF: metres, radians, kilograms.

    A link for each part that has corners, hung on `root` (default: the base, else the first fixed part), whose frame is
    the object's frame where the pose is known. Masses come from the board's weight; `board_thickness_m` counts only
    where the object tells no thickness. Raises ValueError when no part can be the root, or a panel has no area.
    """
    solids = solids_of(model_object, root, board_g_per_m2, board_thickness_m)
    robot = ET.Element("robot", name=model_object.template)
    robot.append(ET.Comment(_remarks(model_object, solids)))
    robot.append(_mujoco_options())
    ET.SubElement(ET.SubElement(robot, "material", name="cardboard"), "color", rgba=CARDBOARD_RGBA)
    for link in solids.links.values():
        robot.append(_link(link))
    for joint in _joints(solids):
        robot.append(joint)
    ET.indent(robot)
    return '<?xml version="1.0"?>\n' + ET.tostring(robot, encoding="unicode") + "\n"


def _remarks(model_object: Object, solids: Solids) -> str:
    positions = ", ".join(f"{name} {position!r}" for name, position in configuration(model_object).items())
    told = "told by the model" if solids.thickness_told else "assumed"
    input_from_root = solids.links[solids.root].input_from_link
    return "\n    ".join(
        [
            " Made by boxwright. Joint position 0 is a closed flap; it grows as the flap opens.",
            f"Measured positions, rad: {positions or 'no joint'}.",
            f"Root link {solids.root} in the input's frame: xyz {numbers(input_from_root[:3, 3])},"
            f" rpy {numbers(roll_pitch_yaw(input_from_root[:3, :3]))}.",
            f"Board: {solids.board_g_per_m2!r} g/m2, {solids.thickness_m!r} m thick ({told}). ",
        ]
    )


def _mujoco_options() -> ET.Element:
    """MuJoCo alone reads this: without it, it would melt all fixed links into one body."""
    options = ET.Element("mujoco")
    ET.SubElement(options, "compiler", fusestatic="false")
    return options


def _link(solid: SolidLink) -> ET.Element:
    link = ET.Element("link", name=solid.name)
    link.append(_inertial(solid.body))
    link.append(_box("visual", solid.box, solid.link_from_box))
    link.append(_box("collision", solid.box, solid.link_from_box))
    return link


def _inertial(body: Plate) -> ET.Element:
    inertial = ET.Element("inertial")
    ET.SubElement(inertial, "origin", xyz=numbers(body.centre), rpy="0 0 0")
    ET.SubElement(inertial, "mass", value=repr(body.mass_kg))
    axes = "xyz"
    entries = {f"i{axes[i]}{axes[j]}": repr(float(body.inertia[i, j])) for i in range(3) for j in range(i, 3)}
    ET.SubElement(inertial, "inertia", entries)
    return inertial


def _box(kind: str, box: EnclosingBox, link_from_box: Matrix) -> ET.Element:
    element = ET.Element(kind)
    element.append(_origin(link_from_box))
    ET.SubElement(ET.SubElement(element, "geometry"), "box", size=numbers(box.size))
    if kind == "visual":
        ET.SubElement(element, "material", name="cardboard")
    return element


def _joints(solids: Solids) -> list[ET.Element]:
    """A joint for each link but the root, in the order of the parts."""
    frames, root = solids.frames(), solids.root
    elements = []
    for name in frames:
        if name in solids.joint_of:
            elements.append(_hinge(solids.joint_of[name], parent_from_joint(solids.joint_of[name], frames)))
        elif name != root:
            elements.append(_tie(f"{root}_to_{name}", "fixed", root, name, inverse(frames[root]) @ frames[name]))
    return elements


def _hinge(joint: Joint, parent_from_child: Matrix) -> ET.Element:
    element = _tie(joint.name, "revolute", joint.parent, joint.child, parent_from_child)
    ET.SubElement(element, "axis", xyz="1 0 0")
    ET.SubElement(
        element,
        "limit",
        lower=repr(joint.limits[0]),
        upper=repr(joint.limits[1]),
        effort=repr(HINGE_EFFORT_N_M),
        velocity=repr(HINGE_VELOCITY_RAD_PER_S),
    )
    return element


def _tie(name: str, kind: str, parent: str, child: str, parent_from_child: Matrix) -> ET.Element:
    element = ET.Element("joint", name=name, type=kind)
    element.append(_origin(parent_from_child))
    ET.SubElement(element, "parent", link=parent)
    ET.SubElement(element, "child", link=child)
    return element


def _origin(transform: Matrix) -> ET.Element:
    return ET.Element("origin", xyz=numbers(transform[:3, 3]), rpy=numbers(roll_pitch_yaw(transform[:3, :3])))
