"""How far the probabilities of the method `exact` can be believed: on a labelled set, part by part.

    .venv/bin/python benchmarks/calibration.py out/sets/test out/sets/test_none --figure docs/results/calibration.png

Prints the expected calibration error (ten bins of equal count), the area under the ROC curve of right against wrong
parts, and the Brier score beside that of the best constant. A part of an object that no box was given to is wrong;
parts that are neither right nor wrong (docs/formats.md) are left out.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from boxwright.evaluation import list_set, read_entry, score_frame
from boxwright.io.clouds import read_cloud
from boxwright.parallel import ordered_map, processors
from boxwright.pipeline import infer

BINS = 10

Array = NDArray[np.float64]


def parts_of(entry) -> tuple[list[tuple[float, bool]], int]:
    """Probability of each judged part of a frame and whether it is right, and how many have no probability."""
    frame = read_entry(entry)
    inferred = infer(read_cloud(entry.cloud_path), method="exact")
    objects = inferred.model.objects
    score = score_frame(objects, inferred.object_labels, inferred.part_labels, frame.truth, frame.labels)
    verdicts = {(box.object, v.name): v.verdict for box in score.boxes for v in box.verdicts}
    judged, untold = [], 0
    for k, found in enumerate(objects):
        for part in (p for p in found.parts if p.observed):
            verdict = verdicts.get((k, part.name), "wrong")
            if part.probability is None:
                untold += verdict != "neither"
            elif verdict != "neither":
                judged.append((part.probability, verdict == "right"))
    return judged, untold


def bins_of(told: Array, right: Array) -> list[tuple[float, float, int]]:
    """Mean probability, share that is right, and count of each of ten bins of equal count."""
    order = np.argsort(told, kind="stable")
    groups = [group for group in np.array_split(order, BINS) if len(group)]
    return [(float(told[g].mean()), float(right[g].mean()), len(g)) for g in groups]


def calibration_error(bins: list[tuple[float, float, int]]) -> float:
    """Mean distance of told and true, weighed by counts."""
    return sum(abs(told - true) * count for told, true, count in bins) / sum(count for _, _, count in bins)


def area_under_roc(told: Array, right: Array) -> float:
    """How often a right part has a higher probability than a wrong one; ties count half."""
    good, bad = told[right > 0], told[right == 0]
    above = (good[:, None] > bad[None, :]).sum() + 0.5 * (good[:, None] == bad[None, :]).sum()
    return float(above / (len(good) * len(bad)))


def draw(bins: list[tuple[float, float, int]], title: str, path: Path) -> None:
    """The reliability diagram."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(4.2, 4.2), dpi=120, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    axes.plot([0, 1], [0, 1], color="0.6", linewidth=1)
    axes.plot([b[0] for b in bins], [b[1] for b in bins], marker="o", color="tab:blue")
    axes.set(xlabel="probability told", ylabel="share that is right", title=title, xlim=(0, 1), ylim=(0, 1), aspect=1)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, metadata={"Software": None})


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sets", nargs="+", type=Path, help="folders of labelled frames")
    parser.add_argument("--figure", type=Path, help="write the reliability diagram there")
    wanted = parser.parse_args()

    entries = [entry for folder in wanted.sets for entry in list_set(folder)]
    frames = list(ordered_map(parts_of, entries, processors()))
    pairs = np.array([pair for judged, _ in frames for pair in judged], np.float64)
    told, right = pairs[:, 0], pairs[:, 1]
    bins = bins_of(told, right)
    brier, constant = float(np.mean((told - right) ** 2)), float(right.mean() * (1.0 - right.mean()))
    print(f"{len(entries)} frames, {len(told)} judged parts, {100 * right.mean():.1f} % right;", end=" ")
    print(f"{sum(untold for _, untold in frames)} more without a probability")
    print("\n| probability told | share that is right | parts |\n| ---: | ---: | ---: |")
    for mean, share, count in bins:
        print(f"| {mean:.3f} | {share:.3f} | {count} |")
    print(f"\nexpected calibration error {calibration_error(bins):.3f}")
    print(f"area under the ROC curve {area_under_roc(told, right):.3f}")
    print(f"Brier score {brier:.4f}, best constant {constant:.4f}: {100 * (1 - brier / constant):.1f} % better")
    if wanted.figure is not None:
        draw(bins, f"{len(told)} parts of {len(entries)} frames", wanted.figure)


if __name__ == "__main__":
    main()
