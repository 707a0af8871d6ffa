"""What makes a frame hard: clutter, noise, distance, elevation, each swept over the same boxes; and hidden flaps."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from benchmarks.experiments.accuracy import PERCENT, boxes_of, flap_percent, full_percent
from benchmarks.experiments.frames import SWEEP_SEED, Sequence, distance_and_elevation, hidden_flaps
from benchmarks.experiments.lab import Lab
from benchmarks.experiments.report import Report, Table
from matplotlib.figure import Figure

from boxwright import _core
from boxwright.evaluation import BoxScore
from boxwright.models import TEMPLATE_NAMES, load_object_model
from boxwright.simulation import Conditions
from boxwright.types import Truth

SWEEPS: dict[str, tuple[tuple[float, ...], Callable[[float], Conditions]]] = {
    "things beside, touching and inside": (
        (0, 3, 6, 12, 24), lambda v: Conditions(things=int(v), elevation_deg=50.0),
    ),
    "noise, times a Kinect's": ((0.5, 1, 2, 4, 8), lambda v: Conditions(noise=v, things=3, elevation_deg=50.0)),
    "distance (m)": (
        (0.8, 1.2, 1.6, 2.2, 3.0), lambda v: Conditions(distance_m=v, things=3, elevation_deg=50.0),
    ),
    "elevation (deg)": ((20, 35, 50, 65, 80), lambda v: Conditions(elevation_deg=v, things=3)),
}  # fmt: skip
BINS = {"distance (m)": (0.0, 1.0, 1.3, 1.6, 9.0), "elevation (deg)": (0.0, 35.0, 50.0, 65.0, 91.0)}
MOST_HIDDEN = 3
SWEEP_FRAMES, TEST_FRAMES = 36, 90

Cells = tuple[str | float | int | None, ...]
COLUMNS = ("boxes", "missed %", "flap %", "full %")


def run(lab: Lab) -> Report:
    """All sweeps, then the drawn frames in bins."""
    count, test_count = lab.size((SWEEP_FRAMES, TEST_FRAMES), (1, 3))
    models = [load_object_model(name, shipped="ransac")[1] for name in TEMPLATE_NAMES]
    swept = {name: _sweep(lab, models, name, count) for name in SWEEPS}
    tables = [Table(f"{name[0].upper()}{name[1:]}:", (name, *COLUMNS), rows) for name, rows in swept.items()]
    return Report(
        title="What makes a frame hard",
        claim="performance remains stable for boxes of various sizes; the algorithm filters out noise and clutter.",
        how=(
            f"Method paper as shipped (three templates, shipped weights). Sweeps: {count} frames of the six "
            "categories, one box each, the same boxes at every value; else 3 things, elevation 50 deg, and a "
            f"distance at which all fits. Bins: {test_count} frames as `boxwright synth` draws them, boxes by "
            "their truth; a flap is hidden where it has less than 400 readings. *Missed*: boxes without any "
            "object; a box with less than 6000 readings, as far ones have, is not asked for."
        ),
        tables=(*tables, *_bins(lab, models, test_count)),
        draw=lambda figure: _draw(figure, swept),
        size_in=(8.0, 5.0),
    )


def _sweep(lab: Lab, models: list[_core.ObjectModel], name: str, count: int) -> list[Cells]:
    values, conditions = SWEEPS[name]
    rows = []
    for value in lab.size(values, values[:2]):
        sequence = Sequence(SWEEP_SEED, boxes=1).under(conditions(value))
        rows.append((f"{value:g}", *_figures(boxes_of(lab.scores(models, lab.passing_frames(sequence, count))))))
    return rows


def _figures(boxes: list[BoxScore]) -> Cells:
    missed = PERCENT * sum(box.object is None for box in boxes) / len(boxes) if boxes else None
    return len(boxes), missed, flap_percent(boxes), full_percent(boxes)


def _bins(lab: Lab, models: list[_core.ObjectModel], count: int) -> list[Table]:
    frames = lab.frames(lab.tests, count)
    pairs = [
        (box, frame.truth)
        for frame, score in zip(frames, lab.scores(models, frames), strict=True)
        for box in score.boxes
    ]
    tables = [_hidden_table(pairs)]
    for place, (name, edges) in enumerate(BINS.items()):
        values = np.array([distance_and_elevation(truth, box.box)[place] for box, truth in pairs])
        rows = []
        for low, high in pairwise(edges):
            mine = [box for (box, _), value in zip(pairs, values, strict=True) if low <= value < high]
            rows.append((f"{low:g} to {high:g}", *_figures(mine)))
        tables.append(Table(f"Drawn frames by {name}:", (name, *COLUMNS), rows))
    return tables


def _hidden_table(pairs: list[tuple[BoxScore, Truth]]) -> Table:
    hidden = [min(hidden_flaps(truth, box.box), MOST_HIDDEN) for box, truth in pairs]
    rows = [
        (
            f"{k}" if k < MOST_HIDDEN else f"{k} or 4",
            *_figures([b for (b, _), h in zip(pairs, hidden, strict=True) if h == k]),
        )
        for k in range(MOST_HIDDEN + 1)
    ]
    return Table("Drawn frames by hidden flaps:", ("hidden flaps", *COLUMNS), rows)


def _draw(figure: Figure, swept: dict[str, list[Cells]]) -> None:
    panes = figure.subplots(2, 2, sharey=True).ravel()
    for axes, (name, rows) in zip(panes, swept.items(), strict=True):
        x = np.arange(len(rows))
        for column, label in ((3, "flap accuracy"), (4, "full model accuracy"), (2, "boxes missed")):
            values = [np.nan if row[column] is None else row[column] for row in rows]
            axes.plot(x, values, "o-" if column > 2 else "s--", ms=4, label=label)
        axes.set_xticks(x, [str(row[0]) for row in rows])
        axes.set_xlabel(name)
        axes.set_ylabel("%")
    figure.legend(*panes[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
