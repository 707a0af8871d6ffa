"""What became of one input of a command."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from boxwright.cli.failures import Refusal
    from boxwright.types import Model


@dataclass(frozen=True)
class Outcome:
    """One input's answer, or why there is none."""

    cloud: Path
    model: Model | None = None
    files: tuple[Path, ...] = ()
    refusal: Refusal | None = None
