"""simulation.json in and out (docs/formats.md)."""

from __future__ import annotations

from os import PathLike

from boxwright.io.decoding import load_json, save_json
from boxwright.types import Simulation


def load_simulation(path: str | PathLike[str]) -> Simulation:
    """Read a simulation.json: metres, radians, seconds, newtons. Keys of later versions are ignored.

    Raises OSError when the file cannot be read, ValueError naming file and key when it holds no simulation.
    """
    return load_json(path, Simulation)


def save_simulation(simulation: Simulation, path: str | PathLike[str]) -> None:
    """Write a simulation.json. Raises OSError when it cannot be written."""
    save_json(simulation, path)
