"""Errors as one line each on standard error."""

from __future__ import annotations

import os
import sys
import traceback

from boxwright.cli import DEBUG_VARIABLE

Refusal = ValueError | OSError
"""What an input that cannot be used raises."""


def one_line(error: Exception) -> str:
    """`file: place: problem; mend` of an error."""
    if isinstance(error, OSError) and error.filename is not None and error.strerror:
        return f"{os.fsdecode(error.filename)}: {error.strerror}"
    return " ".join(str(error).split())


def tell(error: Exception, source: object = None) -> None:
    """Print an error, naming its source where the message itself does not; with BOXWRIGHT_DEBUG its traceback too."""
    if os.environ.get(DEBUG_VARIABLE):
        traceback.print_exception(error)
    line = one_line(error)
    if source is not None and not line.startswith(str(source)):
        line = f"{source}: {line}"
    warn(line)


def warn(line: str) -> None:
    """Print one line on standard error."""
    print(f"boxwright: {line}", file=sys.stderr, flush=True)
