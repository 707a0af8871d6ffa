"""What else stands around the arm, from a URDF file: boxes, and other shapes by the boxes around them."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from boxwright.kinematics.transforms import Matrix, rigid

LENGTHS = {"box": {"size": 3}, "cylinder": {"radius": 1, "length": 1}, "sphere": {"radius": 1}}
"""Of each shape that is read: its lengths, and how many numbers tell them."""


def read_scene(path: str | PathLike[str]) -> tuple[dict[str, Any], ...]:
    """The collision shapes of a URDF's links as oriented boxes: name, centre_m (3), rotation (3, 3), size_m (3).

    The root link's frame is the robot's base frame; joints must be fixed. A cylinder or sphere counts as the box around
    it. Raises OSError when the file cannot be read, ValueError naming file and link or joint when it is not such a
    scene: sizes that are not finite and above 0, other shapes, a link that is only to be seen.
    """
    try:
        root = ElementTree.fromstring(Path(path).read_bytes())
        poses = _link_poses(root)
        return tuple(
            _thing(link.attrib["name"], poses[link.attrib["name"]], shape)
            for link in root.findall("link")
            for shape in _collisions(link)
        )
    except ElementTree.ParseError as error:
        raise ValueError(f"{path}: is no XML: {error}") from error
    except KeyError as error:
        raise ValueError(f"{path}: a link or joint lacks {error}; see the URDF specification") from error
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from error


def _link_poses(root: ElementTree.Element) -> dict[str, Matrix]:
    """Each link's pose in the root's frame."""
    parent_of = {}
    for joint in root.findall("joint"):
        name = joint.attrib["name"]
        if joint.attrib.get("type") != "fixed":
            raise ValueError(f"joint {name!r} is {joint.attrib.get('type')!r}; things of a scene stand still: fixed")
        parent, child = joint.find("parent"), joint.find("child")
        if parent is None or child is None:
            raise ValueError(f"joint {name!r} has no parent or no child; it ties two links")
        parent_of[child.attrib["link"]] = (parent.attrib["link"], _origin(joint.find("origin"), f"joint {name!r}"))

    def pose(link: str, depth: int = 0) -> Matrix:
        if link not in parent_of:
            return np.eye(4)
        if depth > len(parent_of):
            raise ValueError(f"joints go round in a circle through {link!r}; they must form a tree")
        parent, step = parent_of[link]
        return pose(parent, depth + 1) @ step

    return {link.attrib["name"]: pose(link.attrib["name"]) for link in root.findall("link")}


def _collisions(link: ElementTree.Element) -> list[ElementTree.Element]:
    """A link's collision shapes; a link without any that is to be seen was meant to stand there."""
    found = link.findall("collision")
    if not found and link.find("visual") is not None:
        raise ValueError(
            f"link {link.attrib['name']!r} has a <visual> and no <collision>: the arm would not keep clear of it; give "
            "it a <collision> of the same shape, or take it out"
        )
    return found


def _thing(link: str, root_from_link: Matrix, collision: ElementTree.Element) -> dict[str, Any]:
    pose = root_from_link @ _origin(collision.find("origin"), f"link {link!r}")
    size = _size(f"link {link!r}", collision.find("geometry"))
    return {"name": link, "centre_m": pose[:3, 3].tolist(), "rotation": pose[:3, :3].tolist(), "size_m": size}


def _size(where: str, geometry: ElementTree.Element | None) -> list[float]:
    """x, y, z of the box around a shape."""
    shape = None if geometry is None else next(iter(geometry), None)
    tag = None if shape is None else shape.tag
    if shape is None or tag not in LENGTHS:
        had = "is empty" if tag is None else f"is a {tag}"
        raise ValueError(f"{where}: its collision geometry {had}; give a box, cylinder or sphere around it")
    values = [
        value
        for key, count in LENGTHS[tag].items()
        for value in _numbers(shape.attrib.get(key, ""), count, f"{where}: {tag} {key}", above_0=True)
    ]
    if tag == "box":
        return values
    return [2.0 * values[0], 2.0 * values[0], values[1] if tag == "cylinder" else 2.0 * values[0]]


def _origin(element: ElementTree.Element | None, where: str) -> Matrix:
    if element is None:
        return np.eye(4)
    told = (_numbers(element.attrib.get(key, "0 0 0"), 3, f"{where}: origin {key}") for key in ("xyz", "rpy"))
    xyz, (roll, pitch, yaw) = told
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(angle), np.cos(angle)) for angle in (roll, pitch, yaw))
    rotation = np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
    return rigid(rotation, xyz)


def _numbers(text: str, count: int, where: str, *, above_0: bool = False) -> list[float]:
    """So many finite numbers of a text, all above 0 where that is asked."""
    try:
        values = [float(word) for word in text.split()]
    except ValueError:
        values = []
    fits = len(values) == count and all(np.isfinite(value) and (value > 0.0 or not above_0) for value in values)
    if not fits:
        kind = "finite numbers" if not above_0 else "finite numbers above 0, metres"
        wanted = f"{count} {kind}" if count > 1 else f"a {kind.replace('numbers', 'number')}"
        raise ValueError(f"{where} is {text!r}; must be {wanted}")
    return values
