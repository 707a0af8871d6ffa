"""Decode JSON files into the types, with errors that name file and key."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from threading import Lock
from typing import Any, TypeVar

import msgspec

Record = TypeVar("Record")

_MAKING = Lock()
_DECODERS: dict[type, msgspec.json.Decoder[Any]] = {}


def load_json(path: str | PathLike[str], record: type[Record]) -> Record:
    """Read a JSON file as a record; keys that the record does not know are ignored.

    Raises OSError when the file cannot be read, ValueError `file: key: problem` when it does not hold such a record.
    """
    data = Path(path).read_bytes()
    try:
        return _decoder_of(record).decode(data)
    except RecursionError as error:
        raise ValueError(
            f"{path}: lists or objects are nested too deep; no such file has more than ten levels"
        ) from error
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise ValueError(_one_line(path, str(error))) from error


def save_json(record: msgspec.Struct, path: str | PathLike[str]) -> None:
    """Write a record as indented JSON; equal records give equal bytes. Raises OSError when it cannot be written."""
    Path(path).write_bytes(msgspec.json.format(msgspec.json.encode(record), indent=1) + b"\n")


def _decoder_of(record: type[Record]) -> msgspec.json.Decoder[Record]:
    """Threads that make their first decoder of a type together have crashed: one at a time, and each once."""
    with _MAKING:
        if record not in _DECODERS:
            _DECODERS[record] = msgspec.json.Decoder(record)
        return _DECODERS[record]


def _one_line(path: str | PathLike[str], message: str) -> str:
    """`file: key: problem` from msgspec's "problem - at `$.key`"."""
    problem, separator, place = message.partition(" - at ")
    if not separator:
        return f"{path}: {problem}"
    return f"{path}: {place.strip('`').removeprefix('$.').removeprefix('$')}: {problem}"
