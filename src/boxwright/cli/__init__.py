"""The command line. Imports everything; nobody imports it."""

from __future__ import annotations

DEBUG_VARIABLE = "BOXWRIGHT_DEBUG"
"""Set to anything, it shows the traceback of an error that would be one line."""


def main() -> None:
    """Run one command. Exit status: 0 done, 1 an input or a value was not usable, 2 a wrong command line."""
    from boxwright.cli.app import app
    from boxwright.cli.failures import tell

    try:
        app()
    except (ValueError, OSError) as error:
        tell(error)
        raise SystemExit(1) from None
