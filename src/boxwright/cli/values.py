"""Values on the command line that are several numbers in one word."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import typer


class Triple(NamedTuple):
    """A point or a direction, input's frame; finite."""

    x: float
    y: float
    z: float

    @staticmethod
    def parse(text: str) -> Triple:
        """From "X,Y,Z"."""
        from boxwright.types.checks import require_finite

        x, y, z = _numbers(text, 3)
        _fits(require_finite, text, (x, y, z))
        return Triple(x, y, z)

    @staticmethod
    def parse_direction(text: str) -> Triple:
        """From "X,Y,Z", of any length but 0."""
        from boxwright.types.checks import require_direction

        direction = Triple.parse(text)
        _fits(require_direction, text, direction)
        return direction


class Bounds(NamedTuple):
    """A region of interest, metres, input's frame."""

    x_low: float
    x_high: float
    y_low: float
    y_high: float
    z_low: float
    z_high: float

    @staticmethod
    def parse(text: str) -> Bounds:
        """From "XLO,XHI,YLO,YHI,ZLO,ZHI"."""
        return Bounds(*_numbers(text, 6))


class OuterSize(NamedTuple):
    """An outer size, millimetres, in any order."""

    text: str
    outer_mm: tuple[float, float, float]

    @staticmethod
    def parse(text: str) -> OuterSize:
        """From "LxWxH" in millimetres."""
        from boxwright.io.sizes import known_size

        mend = "a size is LxWxH over the boards in mm, for instance 400x300x200"
        try:
            first, second, third = (float(word) for word in text.lower().split("x"))
        except ValueError:
            raise typer.BadParameter(f"{text!r} is not three lengths; {mend}") from None
        try:
            known_size(text, (first, second, third))
        except ValueError as error:
            raise typer.BadParameter(f"{error}; {mend}") from None
        return OuterSize(text, (first, second, third))


def _fits(check: Callable[[str, tuple[float, ...]], None], text: str, values: tuple[float, ...]) -> None:
    """A wrong command line where a check of the types refuses the values."""
    try:
        check(repr(text), values)
    except ValueError as error:
        raise typer.BadParameter(str(error)) from None


def _numbers(text: str, count: int) -> list[float]:
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        raise typer.BadParameter(f"{text!r} holds something that is no number; must be {count} numbers") from None
    if len(values) != count:
        raise typer.BadParameter(f"{text!r} has {len(values)} numbers; must be {count} with commas between them")
    return values
