"""A piece of the closing set: python -m benchmarks.closing FIRST LAST [--ways A,B] [--creases A,B] [--limits]

Writes out/closing/NNN_WAY_CREASE.json for problems FIRST to LAST - 1 that are not there yet, and with --limits
NNN_limits.json for them, which asks brute force about the flaps that no record planned (a minute for each, or more);
`python -m benchmarks.experiments closing` makes the tables of what is there.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks.closing.measure import limits, measure
from benchmarks.closing.problems import REPORT_SEED, draw_problem
from benchmarks.closing.record import (
    CREASES,
    WAYS,
    Limits,
    Record,
    kept,
    limits_path,
    read_records,
    record_path,
)


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("first", type=int)
    parser.add_argument("last", type=int)
    parser.add_argument("--ways", default=",".join(WAYS))
    parser.add_argument("--creases", default=",".join(CREASES))
    parser.add_argument("--limits", action="store_true")
    parser.add_argument("--out", type=Path, default=Path("out/closing"))
    options = parser.parse_args()
    ways, creases = ([name for name in text.split(",") if name] for text in (options.ways, options.creases))
    for number in range(options.first, options.last):
        try:
            for way in ways:
                for crease in creases:
                    _tell(record_of(options.out, number, way, crease))
            if options.limits:
                found = limits_of(options.out, number)
                print(f"{number} brute force: {found.feasible}", flush=True)
        except ValueError as error:
            # A flap that reaches into the arm's ready pose: nothing can be planned there.
            print(f"{number} is left out: {error}", flush=True)


def record_of(folder: Path, number: int, way: str, crease: str) -> Record:
    """That of the folder, measured first where it is not there."""
    path = record_path(folder, number, way, crease)
    return kept(path, Record, lambda: measure(draw_problem(number, REPORT_SEED), way, crease))


def limits_of(folder: Path, number: int) -> Limits:
    """The same of a problem's limits; the records that are there say which flaps are planned."""

    def made() -> Limits:
        found = read_records(folder, [number], ("layered", "paper"), CREASES)
        planned = sorted({flap.name for record in found for flap in record.flaps if flap.status == "planned"})
        return limits(draw_problem(number, REPORT_SEED), planned)

    return kept(limits_path(folder, number), Limits, made)


def _tell(record: Record) -> None:
    planned, held = sum(f.status == "planned" for f in record.flaps), sum(f.held for f in record.flaps)
    said = f"{record.number} {record.category} {record.way} {record.crease}: planned {planned}, held {held}"
    print(f"{said} of {len(record.flaps)}" + (f"; {record.failure}" if record.failure else ""), flush=True)


if __name__ == "__main__":
    main()
