"""Creases as data: how stiff a class of crease is, and how far its flaps spring back (creases.toml)."""

from __future__ import annotations

import tomllib
from importlib import resources
from os import PathLike
from pathlib import Path

import msgspec
import numpy as np

from boxwright.types.checks import require_positive

SHIPPED = "creases.toml"


class Crease(msgspec.Struct, frozen=True, kw_only=True):
    """A class of creases: an ideal elasto-plastic hinge.

    It takes `moment_n_m_per_m`, for each metre of crease in board of `board_mm`, to fold it on, and in proportion more
    in thicker board; let go, the flap comes back by `return_deg`.
    """

    moment_n_m_per_m: float
    board_mm: float
    return_deg: float

    def __post_init__(self) -> None:
        require_positive("moment_n_m_per_m", [self.moment_n_m_per_m])
        require_positive("board_mm", [self.board_mm])
        require_positive("return_deg", [self.return_deg])

    @property
    def return_rad(self) -> float:
        """The elastic band: the rest angle moves once the flap is further from it than this."""
        return float(np.radians(self.return_deg))

    def moment_n_m(self, length_m: float, thickness_m: float) -> float:
        """What folds a crease of this length on, in board of this thickness.

        The liners of a folded board pull and press with what they bear, the board's thickness apart.
        """
        return self.moment_n_m_per_m * length_m * thickness_m / (self.board_mm / 1000.0)

    def stiffness_n_m_per_rad(self, length_m: float, thickness_m: float) -> float:
        """The elastic spring of such a crease."""
        return self.moment_n_m(length_m, thickness_m) / self.return_rad


class Creases(msgspec.Struct, frozen=True, kw_only=True):
    """A crease file: its classes by name, and where their figures are from."""

    format: str
    version: int
    sources: tuple[str, ...]
    assumptions: tuple[str, ...]
    classes: dict[str, Crease] = msgspec.field(name="class")

    def __post_init__(self) -> None:
        if (self.format, self.version) != ("boxwright.creases", 1):
            raise ValueError(f"format is {self.format!r}, version {self.version}; must be 'boxwright.creases', 1")


def load_creases(path: str | PathLike[str] | None = None) -> Creases:
    """The shipped crease file, or one's own.

    Raises OSError when the file cannot be read, ValueError naming file and key when it is no crease file.
    """
    shipped = resources.files("boxwright.simulation.physics").joinpath(SHIPPED)
    text = shipped.read_text(encoding="utf-8") if path is None else Path(path).read_text(encoding="utf-8")
    try:
        return msgspec.convert(tomllib.loads(text), Creases)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError, ValueError) as error:
        raise ValueError(f"{path or SHIPPED}: {error}") from error


def crease_class(name: str, path: str | PathLike[str] | None = None) -> Crease:
    """A class of creases by its name; raises as `load_creases`, and ValueError naming those that are known."""
    classes = load_creases(path).classes
    if name not in classes:
        raise ValueError(f"crease is {name!r}; must be one of {', '.join(classes)}")
    return classes[name]
