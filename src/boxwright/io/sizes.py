"""Catalogues of box sizes: TOML files (docs/formats.md)."""

from __future__ import annotations

import os
import tomllib
from pathlib import Path

import msgspec

from boxwright import _core
from boxwright.types import KnownSize
from boxwright.types.checks import require_positive

MM = 1000.0
"""Millimetres in a metre: people measure boxes in mm."""


class _Entry(msgspec.Struct, kw_only=True, forbid_unknown_fields=True):
    name: str
    outer_mm: tuple[float, float, float]


class _Catalogue(msgspec.Struct, kw_only=True, forbid_unknown_fields=True):
    size: list[_Entry]


def read_sizes(path: str | os.PathLike[str]) -> tuple[KnownSize, ...]:
    """The sizes of a catalogue, in its order: `[[size]]` tables with `name` and `outer_mm`, three lengths in any order.

    Raises OSError when it cannot be read; ValueError with file, entry and mend where it is wrong: no sizes, one name
    twice, lengths that no box has.
    """
    path = Path(path)
    try:
        content = msgspec.convert(tomllib.loads(path.read_text(encoding="utf-8")), _Catalogue)
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ValueError(
            f"{path}: {error}; a catalogue is [[size]] tables with name and outer_mm = [L, W, H]"
        ) from None
    if not content.size:
        raise ValueError(f"{path}: holds no sizes; give at least one [[size]] table")
    sizes: dict[str, KnownSize] = {}
    for number, entry in enumerate(content.size, start=1):
        place = f"{path}: size {number}"
        if entry.name in sizes:
            raise ValueError(f"{place}: {entry.name!r} is there already; names must differ")
        try:
            sizes[entry.name] = known_size(entry.name, entry.outer_mm)
        except ValueError as error:
            raise ValueError(f"{place}: {error}") from None
    return tuple(sizes.values())


def known_size(name: str, outer_mm: tuple[float, float, float]) -> KnownSize:
    """A size given in millimetres. Raises ValueError, naming it, where no box has it."""
    require_positive(f"size {name!r}: outer_mm", outer_mm)
    length, width, height = (mm / MM for mm in outer_mm)
    size = KnownSize(name=name, outer=(length, width, height))
    _core.check_sizes([(size.name, size.outer)])
    return size
