"""From a cloud to planar segments with rectangles; no segment has a meaning yet."""

from __future__ import annotations

from boxwright import _core
from boxwright._core import Perception
from boxwright.types import Cloud
from boxwright.types.checks import require_direction

__all__ = ["Perception", "chosen", "perceive", "require_planes"]


def perceive(
    cloud: Cloud, *, up: tuple[float, float, float] | None = None, planes: str | None = None, **settings: float | str
) -> Perception:
    """Support plane, clusters and planar segments of a cloud, as in the paper's section "Perception".

    `up` is the direction away from the support in the input's frame, any length; None finds it. `planes` names the
    front end, one of `_core.PLANES`. `settings` replace single values of the core's `PerceptionSettings` by name, e.g.
    `cluster_gap_m=0.03`. Equal input gives equal bits.

    Raises ValueError with one line where the cloud has no finite reading, where `up` is no direction or several could
    be up, where the support is seen from below, or where a front end or setting does not exist.
    """
    if up is not None:
        require_direction("up", up)
    require_planes(planes)
    settings |= chosen(planes)
    return _core.perceive(cloud.points, cloud.width, cloud.height, cloud.viewpoint, up, **settings)


def require_planes(planes: str | None) -> None:
    """Refuse a front end that the core does not have; None, no choice, passes."""
    if planes is not None and planes not in _core.PLANES:
        raise ValueError(f"planes {planes!r} is not known; known are {', '.join(_core.PLANES)}")


def chosen(planes: str | None) -> dict[str, float | str]:
    """The settings that a choice of front end comes to; without a choice it is the core's."""
    return {} if planes is None else {"planes": planes}
