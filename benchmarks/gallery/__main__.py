"""What stands in the way: figures by how much is seen of a box, and pictures of frames from best to worst.

    python -m benchmarks.gallery SET EVALUATION.json -o FOLDER [--without SET EVALUATION.json]

EVALUATION.json is what `boxwright evaluate SET -o EVALUATION.json` wrote. FOLDER gets README.md, with the figures by
panels in the cloud, by boxes in the frame and by how flaps are seen, and each lost flap's cause; gallery.png: the best,
the middle and the worst frames, what was told in colour, true panels that no right part holds outlined in red;
lost.png: frames that lose flaps, by how those are seen; and with --without, a set that holds no open box, false.png:
the frames of it in which one is told.
"""

from __future__ import annotations

import argparse
import json
import shlex
import sys
from pathlib import Path

from benchmarks.gallery.how_seen import seen_flaps
from benchmarks.gallery.pictures import chosen, save, with_false_objects, with_lost_flaps
from benchmarks.gallery.tables import boxes_of, by_panels, by_sight, causes, table


def main() -> None:
    """Reads the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("set", type=Path)
    parser.add_argument("evaluation", type=Path)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--without", type=Path, nargs=2, metavar=("SET", "EVALUATION"))
    options = parser.parse_args()
    evaluation = json.loads(options.evaluation.read_text())
    boxes, flaps = list(boxes_of(evaluation)), list(seen_flaps(options.set, evaluation))
    lines = [
        "# What stands in the way",
        "",
        f"`python -m benchmarks.gallery {shlex.join(sys.argv[1:])}`",
        "",
        f"{len(boxes)} boxes, method {evaluation['method']}.",
        "",
        *by_panels(boxes),
        *table("boxes in the frame", boxes, lambda count, _: str(count)),
        *causes(boxes),
        *by_sight(flaps),
        "Of a flap the first of these that holds counts.",
        "",
        "![The best frame, the middle one and the ten worst](gallery.png)",
        "",
        "The best frame, the middle one, and the ten worst; true panels that no right part holds are outlined in red.",
        "",
        "![Frames that lose flaps, by how those are seen](lost.png)",
        "",
        "Frames that lose flaps, by how those are seen; whatever else is lost in them is outlined too.",
    ]
    options.out.mkdir(parents=True, exist_ok=True)
    save(chosen(evaluation), options.set, evaluation, options.out / "gallery.png")
    save(with_lost_flaps(flaps), options.set, evaluation, options.out / "lost.png")
    if options.without:
        folder, path = options.without
        without = json.loads(path.read_text())
        false = with_false_objects(without)
        count = len(without["frames"])
        lines += ["", f"Of {count} frames without an open box those in which one is told: {len(false)}."]
        if false:
            save(false, folder, without, options.out / "false.png")
            lines += ["", "![Frames without an open box in which one is told](false.png)"]
    (options.out / "README.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    main()
