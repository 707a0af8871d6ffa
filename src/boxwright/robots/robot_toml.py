"""A robot's record as the text of its file."""

from __future__ import annotations

import json
from typing import Any

import msgspec

from boxwright.types import BeyondUrdf, RobotFile

_LISTED = ("joint", "link")
"""Tables that come several times."""


def toml_text(robot: RobotFile | BeyondUrdf) -> str:
    """The TOML that reads back as this record, whose numbers are finite."""
    keys = {key: value for key, value in msgspec.to_builtins(robot).items() if value is not None}
    head = [_line(key, value) for key, value in keys.items() if not _is_table(key, value)]
    blocks = ["\n".join(head)]
    for key, value in keys.items():
        if key in _LISTED:
            blocks += [_table(f"[[{key}]]", item) for item in value]
        elif _is_table(key, value):
            blocks.append(_table(f"[{key}]", value))
    return "\n\n".join(blocks) + "\n"


def _is_table(key: str, value: Any) -> bool:
    return key in _LISTED or isinstance(value, dict)


def _table(head: str, values: dict[str, Any]) -> str:
    return "\n".join([head, *(_line(key, value) for key, value in values.items())])


def _line(key: str, value: Any) -> str:
    return f"{key} = {_value(value)}"


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(_line(key, inner) for key, inner in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_value(inner) for inner in value) + "]"
    # JSON's strings and numbers are TOML's, where they are finite.
    return json.dumps(value, ensure_ascii=False, allow_nan=False)
