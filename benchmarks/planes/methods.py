"""The ways of finding planes that are measured: our own, and what users of PCL and Open3D would write."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from functools import cache

from planes.ours import PLANES, has_planes
from planes.pcl_build import build_pcl
from planes.runs import python_program

OURS = PLANES


@dataclass(frozen=True)
class Method:
    """`slow`: takes about a second a frame, so it gets a part of the frames, once each."""

    key: str
    name: str
    slow: bool = False


METHODS = (
    Method("grid", "boxwright, planes=grid"),
    Method("ransac", "boxwright, planes=ransac"),
    Method("organized", "PCL: organized multi-plane segmentation"),
    Method("voxels", "PCL: RANSAC, clusters, RANSAC, hulls; 10 mm voxels"),
    Method("classical", "PCL: the same, every point", slow=True),
    Method("open3d-voxels", "Open3D: RANSAC, DBSCAN, RANSAC, hulls; 10 mm voxels", slow=True),
    Method("open3d", "Open3D: the same, every point", slow=True),
    Method("open3d-patches", "Open3D: planar patches", slow=True),
)
PCL = ("organized", "voxels", "classical")


def program_of(method: Method) -> tuple[list[str] | None, str]:
    """The command that runs it, or None and why there is none."""
    if method.key in OURS:
        return (python_program("worker"), "") if has_planes(method.key) else (None, "this build does not have it")
    if method.key in PCL:
        program, why_not = _pcl()
        return program, why_not
    if importlib.util.find_spec("open3d") is None:
        return None, "Open3D is not installed (PyPI: open3d)"
    return python_program("worker"), ""


@cache
def _pcl() -> tuple[list[str] | None, str]:
    program, why_not = build_pcl()
    return ([str(program)] if program else None), why_not
