"""model.json in and out (docs/formats.md)."""

from __future__ import annotations

from os import PathLike

from boxwright.io.decoding import load_json, save_json
from boxwright.types import Model


def load_model(path: str | PathLike[str]) -> Model:
    """Read a model.json: metres, radians, the input's frame. Keys of later versions are ignored.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no usable model.
    """
    return load_json(path, Model)


def save_model(model: Model, path: str | PathLike[str]) -> None:
    """Write a model.json; equal models give equal bytes. Raises OSError when it cannot be written."""
    save_json(model, path)
