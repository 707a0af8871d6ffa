"""Numbers of a robot's file that are none: TOML has nan and inf."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import msgspec


def require_finite_numbers(record: msgspec.Struct) -> None:
    """Raises ValueError naming the first key, as `link[1].capsules[0].radius_m`, whose number is not finite."""
    for key, value in _numbers("", msgspec.to_builtins(record)):
        if not math.isfinite(value):
            raise ValueError(f"{key} is {value}; it must be a finite number")


def _numbers(key: str, value: Any) -> Iterator[tuple[str, float]]:
    if isinstance(value, dict):
        for name, inner in value.items():
            yield from _numbers(f"{key}.{name}" if key else name, inner)
    elif isinstance(value, list | tuple):
        for number, inner in enumerate(value):
            yield from _numbers(f"{key}[{number}]", inner)
    elif isinstance(value, float):
        yield key, value
