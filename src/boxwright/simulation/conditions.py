"""What of a frame is set instead of drawn: one condition can be swept over otherwise equal scenes."""

from __future__ import annotations

import msgspec

from boxwright.simulation.kinds import FURTHER_KINDS, KINDS


class Conditions(msgspec.Struct, frozen=True, kw_only=True):
    """None: as drawn. Boxes, support and walls are the same whatever is set, but for `variant`."""

    variant: str | None = None
    """The kind of all boxes, one of its category's."""
    things: int | None = None
    """Household things to try: touching a box, inside one, around, in turn; those of n are the first of n + 1."""
    elevation_deg: float | None = None
    """Of the camera over the horizon of what it looks at."""
    distance_m: float | None = None
    """Of the camera from the middle of what it looks at, kept even where the frame's edge then cuts something."""
    noise: float = 1.0
    """Times the Kinect's noise in disparity."""

    def check(self, category: str) -> None:
        """Raises ValueError, saying what would be right, where no frame of the category can be so."""
        kinds = tuple((KINDS | FURTHER_KINDS).get(category, ()))
        if self.variant is not None and self.variant not in kinds:
            raise ValueError(
                f"variant is {self.variant!r}; of {category} it can be {', '.join(kinds) or 'none at all'}"
            )
        if self.things is not None and self.things < 0:
            raise ValueError(f"things is {self.things}; must be 0 or more")
        if self.elevation_deg is not None and not 0.0 < self.elevation_deg <= 90.0:
            raise ValueError(f"elevation_deg is {self.elevation_deg}; must be above 0, at most 90")
        if self.distance_m is not None and not 0.5 <= self.distance_m <= 4.5:
            raise ValueError(f"distance_m is {self.distance_m}; must be from 0.5 to 4.5, where the sensor reads")
        if not 0.0 <= self.noise <= 100.0:
            raise ValueError(f"noise is {self.noise}; must be from 0 to 100 times the Kinect's")


DRAWN = Conditions()
"""Everything as it is drawn."""
