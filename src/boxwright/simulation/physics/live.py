"""A simulated box that can be looked at and acted upon by turns: the sensor's frames of it, and the arm in physics."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec
import numpy as np
from numpy.typing import NDArray

from boxwright.simulation.frames import Frame
from boxwright.simulation.physics.boards import BoardBox, modelled_box
from boxwright.simulation.physics.look import look_again
from boxwright.simulation.physics.matching import match_of
from boxwright.simulation.physics.session import Session
from boxwright.types import Cloud, Model, Plan, PlanSegment

Array = NDArray[np.float64]


class LiveBox:
    """Mutable: every look has noise of its own, every act moves the box.

    The camera stands still at `base_from_input`; other boxes stand still too. Flaps keep the names that the session's
    box has, however a later model numbers its sides.
    """

    def __init__(
        self, session: Session, base_from_input: Array, others: Sequence[BoardBox] = (), seed: int = 0
    ) -> None:
        self.session = session
        self._base_from_input, self._others = base_from_input, tuple(others)
        self._seed = seed
        self._pushed: list[str] = []

    @property
    def pushed(self) -> tuple[str, ...]:
        """The flaps that plans pushed until now, each once, by the names that the session's box has."""
        return tuple(dict.fromkeys(self._pushed))

    def frame(self) -> Frame:
        """The next frame, with its truth."""
        self._seed += 1
        return look_again((self.session.box_now(), *self._others), self._base_from_input, self._seed)

    def look(self) -> Cloud:
        """The next frame as a cloud, seen from the camera."""
        return cloud_of(self.frame())

    def act(self, plan: Plan, model: Model) -> str | None:
        """Follows a plan that was made on a model of this box; where the arm was stopped, None where it was not.

        That physics came apart is told alike.

        Raises ValueError where the planned object stands where the box does not.
        """
        found = model.objects[plan.object]
        modelled = modelled_box(found, model.up, np.array(plan.base_from_input))
        _, shift = match_of([self.session.box_now()], modelled)
        segments = [_renamed(segment, shift) for segment in plan.segments]
        self._pushed += [segment.flap for segment in segments if segment.flap is not None and segment.kind == "push"]
        self.session.follow(segments)
        return self.session.ended


def cloud_of(frame: Frame) -> Cloud:
    """A frame's points as the cloud that its file would be read as."""
    return Cloud(
        points=np.ascontiguousarray(frame.points),
        width=frame.width,
        height=frame.height,
        viewpoint=(0.0, 0.0, 0.0),
        colors=np.ascontiguousarray(frame.colors),
    )


def _renamed(segment: PlanSegment, shift: int) -> PlanSegment:
    """The segment with its flap called as the box calls the one on that side."""
    if segment.flap is None or shift == 0:
        return segment
    stem, number = segment.flap.split("_")
    return msgspec.structs.replace(segment, flap=f"{stem}_{(int(number) + shift) % 4}")
