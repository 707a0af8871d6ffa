"""Results of scoring, records that are written as JSON and compared later. Metres and radians."""

from __future__ import annotations

from typing import Literal

import msgspec

Verdict = Literal["right", "wrong", "neither"]


class PartVerdict(msgspec.Struct, frozen=True, kw_only=True):
    """What became of one observed part: `role` is the true panel that its name stands for under the chosen rotation.

    `neither`: it lies on the panel of its role, which has too few readings to count. `points_on_role` of its `points`
    lie there; `mostly_on` is the true panel (of any box) that holds most of them, None where that is no panel.
    """

    name: str
    role: str
    verdict: Verdict
    points: int
    points_on_role: int
    mostly_on: str | None


class FlapError(msgspec.Struct, frozen=True, kw_only=True):
    """Errors of a right flap against its true panel; `flap` is the true flap's name.

    `hinge_angle_rad` is between the directed axes, `hinge_distance_m` from the true hinge's midpoint to the predicted
    line, `flap_angle_rad` |position - truth|.
    """

    flap: str
    hinge_angle_rad: float
    hinge_distance_m: float
    flap_angle_rad: float


class BoxScore(msgspec.Struct, frozen=True, kw_only=True):
    """One true box that is asked for. `object` is the index of the object that it got, None where it got none.

    Counts are of panels in the cloud (at least 400 readings) and of observed parts; panels are base, sides and flaps,
    tucks (flaps on flaps) are counted apart. `missed` names panels in the cloud, tucks too, that no right part holds.
    `dimension_errors_m` are |length|, |width|, |height| differences under the rotation; None where nothing was told.
    `flaps_unmeasured` are those in the cloud whose hinge and angle the truth does not tell: they have no errors.
    """

    box: int
    category: str
    variant: str
    readings: int
    object: int | None
    rotation: int | None
    flaps_in_cloud: int
    flaps_right: int
    flaps_wrong: int
    panels_in_cloud: int
    panels_right: int
    panels_wrong: int
    tucks_in_cloud: int
    tucks_found: int
    tucks_wrong: int
    missed: tuple[str, ...]
    verdicts: tuple[PartVerdict, ...]
    flap_errors: tuple[FlapError, ...]
    dimension_errors_m: tuple[float, float, float] | None
    flaps_unmeasured: int = 0

    @property
    def flap_accuracy(self) -> float | None:
        """(right - wrong) / in the cloud over flaps; None for a box without a flap in the cloud."""
        return _accuracy(self.flaps_right, self.flaps_wrong, self.flaps_in_cloud)

    @property
    def full_accuracy(self) -> float | None:
        """The same over base, sides and flaps."""
        return _accuracy(self.panels_right, self.panels_wrong, self.panels_in_cloud)


class FrameScore(msgspec.Struct, frozen=True, kw_only=True):
    """One labelled frame. `boxes` are those asked for; `false_objects` counts objects that no true box was left for."""

    name: str
    category: str
    objects: int
    false_objects: int
    boxes: tuple[BoxScore, ...]


def _accuracy(right: int, wrong: int, in_cloud: int) -> float | None:
    return (right - wrong) / in_cloud if in_cloud else None
