"""A piece of the closing set: python -m benchmarks.closing FIRST LAST [--methods A,B] [--creases A,B]

Writes out/closing/NNN_METHOD.json for problems FIRST to LAST - 1 that are not there yet; `python -m
benchmarks.experiments closing` makes the table of what is there and the rest.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.closing.record import CREASES, METHODS, records


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--methods", default=",".join(METHODS))
    parser.add_argument("--creases", default=",".join(CREASES))
    parser.add_argument("--out", type=Path, default=Path("out/closing"))
    options = parser.parse_args()
    for number in range(options.first, options.last):
        for record in records(options.out, [number], options.methods.split(","), options.creases.split(",")):
            planned = sum(flap.status == "planned" for flap in record.flaps)
            held = {
                crease: sum(flap.held.get(crease, False) for flap in record.flaps)
                for crease in options.creases.split(",")
            }
            print(
                f"{record.number} {record.category} {record.method}: planned {planned}, held {held}",
                flush=True,
            )


if __name__ == "__main__":
    main()
