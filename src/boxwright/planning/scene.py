"""What else stands around the arm, from a URDF file: boxes, and other shapes by the boxes around them."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from boxwright.kinematics.transforms import Matrix, rigid


def read_scene(path: str | PathLike[str]) -> tuple[dict[str, Any], ...]:
    """The collision shapes of a URDF's links as oriented boxes: name, centre_m (3), rotation (3, 3), size_m (3).

    The root link's frame is the robot's base frame; joints must be fixed. A cylinder or sphere counts as the box around
    it. Raises OSError when the file cannot be read, ValueError naming file and element when it is not such a scene.
    """
    try:
        root = ElementTree.fromstring(Path(path).read_bytes())
        poses = _link_poses(root)
        return tuple(
            _thing(link.attrib["name"], poses[link.attrib["name"]] @ _origin(shape.find("origin")), shape)
            for link in root.findall("link")
            for shape in link.findall("collision")
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
        parent_of[child.attrib["link"]] = (parent.attrib["link"], _origin(joint.find("origin")))

    def pose(link: str, depth: int = 0) -> Matrix:
        if link not in parent_of:
            return np.eye(4)
        if depth > len(parent_of):
            raise ValueError(f"joints go round in a circle through {link!r}; they must form a tree")
        parent, step = parent_of[link]
        return pose(parent, depth + 1) @ step

    return {link.attrib["name"]: pose(link.attrib["name"]) for link in root.findall("link")}


def _thing(link: str, pose: Matrix, collision: ElementTree.Element) -> dict[str, Any]:
    size = _size(link, collision.find("geometry"))
    return {"name": link, "centre_m": pose[:3, 3].tolist(), "rotation": pose[:3, :3].tolist(), "size_m": size}


def _size(link: str, geometry: ElementTree.Element | None) -> list[float]:
    shape = None if geometry is None else next(iter(geometry), None)
    if shape is not None and shape.tag == "box":
        return _three(shape.attrib["size"], "size")
    if shape is not None and shape.tag == "cylinder":
        width, length = 2.0 * float(shape.attrib["radius"]), float(shape.attrib["length"])
        return [width, width, length]
    if shape is not None and shape.tag == "sphere":
        return [2.0 * float(shape.attrib["radius"])] * 3
    raise ValueError(f"link {link!r} has no box, cylinder or sphere as collision geometry; meshes are not read")


def _origin(element: ElementTree.Element | None) -> Matrix:
    if element is None:
        return np.eye(4)
    roll, pitch, yaw = _three(element.attrib.get("rpy", "0 0 0"), "rpy")
    (sr, cr), (sp, cp), (sy, cy) = ((np.sin(angle), np.cos(angle)) for angle in (roll, pitch, yaw))
    rotation = np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
    return rigid(rotation, _three(element.attrib.get("xyz", "0 0 0"), "xyz"))


def _three(text: str, key: str) -> list[float]:
    values = [float(word) for word in text.split()]
    if len(values) != 3 or not np.isfinite(values).all():
        raise ValueError(f"{key} is {text!r}; it holds three numbers")
    return values
