"""The published JSON Schemas, generated from the types: `python -m boxwright.io.schemas docs/schemas`."""

from __future__ import annotations

import inspect
import json
import sys
from pathlib import Path

import msgspec

from boxwright.types import Model, Plan, Segmentation, Simulation, Truth

DIALECT = "https://json-schema.org/draft/2020-12/schema"

SCHEMAS: dict[str, tuple[type[msgspec.Struct], str]] = {
    "model.schema.json": (Model, "boxwright model.json, version 1"),
    "plan.schema.json": (Plan, "boxwright plan.json, version 1"),
    "segments.schema.json": (Segmentation, "boxwright segments.json, version 1"),
    "simulation.schema.json": (Simulation, "boxwright simulation.json, version 1"),
    "truth.schema.json": (Truth, "boxwright NAME.truth.json of a scene set"),
}
"""File name to the type that it describes, and its title."""


def schema_text(name: str) -> str:
    """The text of a schema file; what a shape cannot say (unit vectors, names that must match) the types check."""
    record, title = SCHEMAS[name]
    schema = {"$schema": DIALECT, "title": title, **msgspec.json.schema(record)}
    for definition in schema["$defs"].values():
        # Python 3.13 takes a docstring's indentation away by itself, 3.11 does not: the file must not depend on it.
        definition["description"] = inspect.cleandoc(definition["description"])
    return json.dumps(schema, indent=2) + "\n"


def write_schemas(folder: Path) -> None:
    """Write every schema into a folder, which is made where it is missing."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in SCHEMAS:
        (folder / name).write_text(schema_text(name), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python -m boxwright.io.schemas FOLDER")
    write_schemas(Path(sys.argv[1]))
