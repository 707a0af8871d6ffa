"""What tells templates of fitted boxes apart, as data (`boxwright.kinds`, version 1)."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import msgspec

from boxwright import _core

_FILE = Path(__file__).parent / "weights" / "fitted" / "kinds.json"


class KindsReport(msgspec.Struct, frozen=True, kw_only=True):
    """How the weights came to be; errors are means of -log of the true template's probability."""

    command: str
    boxes: int
    regularizer: float
    fit_error: float
    held_out_error: float
    held_out_accuracy: float
    """Share of the training boxes whose template comes first by weights that were fitted without their frame."""


class LearnedKinds(msgspec.Struct, frozen=True, kw_only=True):
    """For each template what each feature of a fitted body's shape counts (docs/maths.md, eq. 89)."""

    weights: dict[str, dict[str, float]]
    training: KindsReport | None = None
    format: Literal["boxwright.kinds"] = "boxwright.kinds"
    version: Literal[1] = 1

    def save(self, path: str | Path) -> None:
        """Writes the weights as JSON."""
        text = msgspec.json.format(msgspec.json.encode(self), indent=1)
        Path(path).write_bytes(text + b"\n")


def load_kinds(path: str | Path = _FILE) -> _core.Kinds:
    """The shipped weights, or those of a file.

    Raises ValueError naming the file and the key that does not fit, OSError where the file cannot be read.
    """
    try:
        return _core.Kinds(Path(path).read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
