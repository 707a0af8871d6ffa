"""Values on the command line that are several numbers in one word."""

from __future__ import annotations

from typing import NamedTuple

import typer


class Triple(NamedTuple):
    """A point or a direction, input's frame."""

    x: float
    y: float
    z: float

    @staticmethod
    def parse(text: str) -> Triple:
        """From "X,Y,Z"."""
        x, y, z = _numbers(text, 3)
        return Triple(x, y, z)


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


def _numbers(text: str, count: int) -> list[float]:
    try:
        values = [float(word) for word in text.split(",")]
    except ValueError:
        raise typer.BadParameter(f"{text!r} holds something that is no number; must be {count} numbers") from None
    if len(values) != count:
        raise typer.BadParameter(f"{text!r} has {len(values)} numbers; must be {count} with commas between them")
    return values
