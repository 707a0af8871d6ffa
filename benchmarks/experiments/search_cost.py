"""What a search costs with the number of segments n: all assignments, the paper's staged search, the exact one."""

from __future__ import annotations

from itertools import islice
from math import comb, perm

import numpy as np
from benchmarks.experiments.lab import Lab, fastest_ms
from benchmarks.experiments.report import Report, Table
from benchmarks.inference_problems import FINE
from matplotlib.figure import Figure

from boxwright import _core
from boxwright.models import load_template, load_weights
from boxwright.perception import perceive
from boxwright.simulation import CATEGORIES, Conditions, make_frame
from boxwright.types import Cloud

SEED = 41004
CROWDED = Conditions(things=60, distance_m=1.3)
MOST_FRAMES = 40
"""Crowded frames that are looked at; those of too few segments are passed over."""
SIZES = (5, 6, 7, 8, 9, 12, 15, 20, 25, 30, 40, 50, 60)
EXHAUSTIVE_TO = 9
WHOLE_TO = 40
"""Beyond, the list of all combinations of four sides would fill the memory."""
FIT_FROM = 15
SHIPPED_FIT_FROM = 30
"""Beyond what the shipped limits let it search with every relation in."""
SAMPLES = 2000
FIXED = ("side_0", "side_1", "side_2", "side_3")

Row = dict[str, float]
WAYS = {
    "all assignments": "ms, exhaustive",
    "staged, every relation in": "ms, every relation in",
    "staged, as shipped": "ms, staged as shipped",
    "exact": "ms, exact",
}


def run(lab: Lab) -> Report:
    """Medians over problems of each size."""
    sizes, count = lab.size((SIZES, 5), ((5, 6, 9), 1))
    scenes = list(islice((scene for scene in map(_crowded, range(MOST_FRAMES)) if len(scene) >= sizes[-1]), count))
    rows = [_measured(lab, n, scenes) for n in sizes]
    first = {"all assignments": 0, "staged, as shipped": SHIPPED_FIT_FROM}
    fits = [(way, *_fit(rows, key, first.get(way, FIT_FROM))) for way, key in WAYS.items()]
    fits += [(f"{name}, counted", *_fit(rows, name, FIT_FROM)) for name in ("assignments", "combinations of sides")]
    columns = ("n", "assignments", "combinations of sides", *WAYS.values(), "nodes, exact", "contested %")
    cells = [tuple(_cell(row.get(column)) for column in columns) for row in rows]
    return Report(
        title="Search cost against the number of segments",
        claim="exhaustive search is O(n^m), n^9 for a box; with four sides chosen the rest is linear, n^5 in all.",
        how=(
            f"Medians over {len(scenes)} problems of each size: the first n segments, group by group, of crowded "
            "simulated frames (three boxes, up to 60 things, RANSAC that keeps every scrap), shipped carton "
            "weights, one thread, milliseconds of CPU time. *Assignments* and *combinations of sides* are "
            "counted by formula, empty parts in, symmetries not taken out. *As shipped* the staged search leaves "
            "relations out of its first stage above 25 segments. *Contested*: of the combinations of sides (2000 "
            "drawn) the share in which two of base and flaps want the same segment, where choosing each for "
            "itself, the paper's linear step, would give a segment two parts; here it is given once."
        ),
        tables=(
            Table("Cost:", columns, cells),
            Table(
                "Exponents k of n^k, least squares in logarithms:",
                ("search", "k", "from n", "to n"),
                fits,
            ),
        ),
        draw=lambda figure: _draw(figure, rows),
        size_in=(8.0, 4.2),
    )


def assignments(n: int, parts: int) -> int:
    """Ways of giving each of some parts one of n segments or none, no segment twice."""
    return sum(comb(parts, k) * perm(n, k) for k in range(min(n, parts) + 1))


def _crowded(index: int) -> _core.Perception:
    frame = make_frame(CATEGORIES[index % len(CATEGORIES)], SEED, index, boxes=3, conditions=CROWDED)
    cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
    return perceive(cloud, planes="ransac", **FINE)


def _first_segments(scene: _core.Perception, n: int) -> list[int]:
    """Group by group, the largest first; support and room last."""
    order = np.argsort(np.where(scene.groups < 0, np.iinfo(np.int32).max, scene.groups), kind="stable")
    return [int(s) for s in order[:n]]


def _measured(lab: Lab, n: int, scenes: list[_core.Perception]) -> Row:
    template, learned = load_template("carton"), load_weights("carton", "ransac")
    weights = learned.vector(template)
    importance = np.array([learned.importance[name] for name in template.feature_names + template.relation_names])
    problems = [_core.Problem.of_segments(scene, template, _first_segments(scene, n)) for scene in scenes]
    repeats = lab.size(2, 1)
    row: Row = {
        "n": n,
        "assignments": assignments(n, len(template.parts)),
        "combinations of sides": assignments(n, len(FIXED)),
        "ms, staged as shipped": _median_ms(lambda p: p.rank(weights, importance, 1), problems, repeats),
        "ms, exact": _median_ms(lambda p: p.solve(weights), problems, repeats),
        "nodes, exact": float(np.median([p.solve(weights)[4] for p in problems])),
        "contested %": 100.0 * float(np.mean([contested(p, template, weights) for p in problems])),
    }
    if n <= lab.size(EXHAUSTIVE_TO, 6):
        row["ms, exhaustive"] = _median_ms(lambda p: p.exhaustive(weights), problems, 1)
    if n <= WHOLE_TO:
        whole = {"max_candidates": 10**9}
        row["ms, every relation in"] = _median_ms(lambda p: p.rank(weights, importance, 1, **whole), problems, 1)
    return row


def contested(problem: _core.Problem, template: _core.Template, weights: np.ndarray) -> float:
    """Share of drawn combinations of four sides in which two other parts' own best choices are one segment."""
    own, pairs, tied = problem.score_tables(weights)
    sides = [template.parts.index(name) for name in FIXED]
    rng = np.random.default_rng(SEED)
    drawn = np.array([1 + rng.choice(len(problem), len(sides), replace=False) for _ in range(SAMPLES)])
    wanted = []
    for part in set(range(len(template.parts))) - set(sides):
        score = np.repeat(own[part][None, :], SAMPLES, axis=0)
        for (first, second), table in zip(pairs, tied, strict=True):
            if first == part and second in sides:
                score += table.T[drawn[:, sides.index(second)]]
            elif second == part and first in sides:
                score += table[drawn[:, sides.index(first)]]
        np.put_along_axis(score, drawn, -np.inf, axis=1)
        wanted.append(score.argmax(axis=1))
    choices = np.array(wanted)
    twice = [(choices[a] == choices[b]) & (choices[a] > 0) for a in range(len(choices)) for b in range(a)]
    return float(np.mean(np.any(twice, axis=0)))


def _median_ms(run: object, problems: list[_core.Problem], repeats: int) -> float:
    return float(np.median([fastest_ms(lambda p=p: run(p), repeats) for p in problems]))  # type: ignore[operator]


def _fit(rows: list[Row], key: str, first: int) -> tuple[float | None, int | None, int | None]:
    """Slope of the logarithm over that of n, and the range of n that it is from."""
    told = [(row["n"], row[key]) for row in rows if key in row]
    used = [pair for pair in told if pair[0] >= first]
    if len(used) < 2:
        return None, None, None
    n, values = np.log(np.array(used, float)).T
    return float(np.polyfit(n, values, 1)[0]), int(used[0][0]), int(used[-1][0])


def _cell(value: float | None) -> str | float | int | None:
    if value is None or isinstance(value, int):
        return value if value is None or value < 10**9 else f"{value:.2e}"
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"


def _draw(figure: Figure, rows: list[Row]) -> None:
    axes = figure.subplots()
    for marker, (way, key) in zip("os^D", WAYS.items(), strict=True):
        told = [(row["n"], row[key]) for row in rows if key in row]
        axes.plot(*zip(*told, strict=True), marker + "-", ms=4, label=way)
    n = np.array([row["n"] for row in rows], float)
    for power, key, style in ((9, WAYS["all assignments"], ":"), (5, WAYS["staged, every relation in"], "--")):
        at, value = next((row["n"], row[key]) for row in rows if key in row)
        axes.plot(n, value * (n / at) ** power, style, color="0.5", lw=1.0, label=f"n^{power}, for comparison")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(3e-2, 1e6)
    axes.set_xticks([int(k) for k in n if k not in (6, 8)], [str(int(k)) for k in n if k not in (6, 8)])
    axes.minorticks_off()
    axes.set_xlabel("segments n")
    axes.set_ylabel("CPU time, median (ms)")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
