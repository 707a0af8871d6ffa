r"""Which template a fitted box is of: learns the weights that tell it, or reports how often it is told right.

    .venv/bin/python -m benchmarks.kinds out/sets/judge out/sets/totes --learn \
        src/boxwright/models/weights/fitted/kinds.json
    .venv/bin/python -m benchmarks.kinds out/sets/test out/sets/totes_test -o docs/results/kinds.md

The true template of a box is that of its category, but for what is in the cloud of it (`boxwright.kinds`). Boxes that
were not found are counted and left out of the table.
"""

from __future__ import annotations

import argparse
import shlex
import sys
from collections import Counter
from pathlib import Path

import numpy as np

from boxwright.evaluation import list_set
from boxwright.kinds import NO_KINDS, KindFrame, examples_of, kind_frames
from boxwright.learning.kinds import learn_kinds
from boxwright.models import FITTED_TEMPLATES


def confusion(frames: list[KindFrame]) -> Counter[tuple[str, str]]:
    """How many boxes of a true template were told to be of which."""
    return Counter(pair for frame in frames for pair in zip(frame.true, frame.told, strict=True))


def report(frames: list[KindFrame], command: str) -> str:
    """The table of true against told templates, as Markdown."""
    counts = confusion(frames)
    chosen = [p for frame in frames for p in frame.probability if p is not None]
    total, right = sum(counts.values()), sum(counts[name, name] for name in FITTED_TEMPLATES)
    lines = [
        "# Which box it is",
        "",
        f"`{command}`",
        "",
        f"{len(frames)} frames, {total} boxes found, {sum(frame.missed for frame in frames)} missed. Told right: "
        f"{right} of {total} ({100 * right / max(total, 1):.1f} %); mean probability of what was told: "
        f"{100 * float(np.mean(chosen)) if chosen else 0.0:.1f} %.",
        "",
        f"| true \\ told | {' | '.join(FITTED_TEMPLATES)} | right % |",
        "| --- |" + " ---: |" * (len(FITTED_TEMPLATES) + 1),
    ]
    for true in FITTED_TEMPLATES:
        row = [counts[true, told] for told in FITTED_TEMPLATES]
        share = f"{100 * counts[true, true] / sum(row):.1f}" if sum(row) else "-"
        lines.append(f"| {true} | {' | '.join(map(str, row))} | {share} |")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Learns or reports."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path, metavar="SET")
    parser.add_argument("--learn", type=Path, metavar="FILE", help="learn from these frames and write the weights")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.md", help="write the table there too")
    options = parser.parse_args()
    command = shlex.join(["python", "-m", "benchmarks.kinds", *sys.argv[1:]])
    entries = [entry for folder in options.sets for entry in list_set(folder)]
    if options.learn is not None:
        learned = learn_kinds(examples_of(kind_frames(entries, NO_KINDS)), command)
        options.learn.parent.mkdir(parents=True, exist_ok=True)
        learned.save(options.learn)
        print(f"{options.learn}: {learned.training}")
        return
    text = report(kind_frames(entries), command)
    print(text)
    if options.output is not None:
        options.output.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
