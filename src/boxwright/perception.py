"""From a cloud to planar segments with rectangles; no segment has a meaning yet."""

from __future__ import annotations

from boxwright import _core
from boxwright._core import Perception
from boxwright.types import Cloud

__all__ = ["Perception", "chosen", "perceive"]


def perceive(
    cloud: Cloud, *, up: tuple[float, float, float] | None = None, planes: str | None = None, **settings: float | str
) -> Perception:
    """Support plane, clusters and planar segments of a cloud, as in the paper's section "Perception".

    `up` is the direction away from the support in the input's frame, any length; None finds it. `planes` names the
    front end, one of `_core.PLANES`. `settings` replace single values of the core's `PerceptionSettings` by name, e.g.
    `cluster_gap_m=0.03`. Equal input gives equal bits.

    Raises ValueError with one line where the cloud has no finite reading, where several directions could be up, where
    the support is seen from below, or where a setting does not exist.
    """
    settings |= chosen(planes)
    return _core.perceive(cloud.points, cloud.width, cloud.height, cloud.viewpoint, up, **settings)


def chosen(planes: str | None) -> dict[str, float | str]:
    """The settings that a choice of front end comes to; without a choice it is the core's."""
    return {} if planes is None else {"planes": planes}
