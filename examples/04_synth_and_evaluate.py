"""Make a labelled set of simulated frames and score the method on it, by category."""

import tempfile

import boxwright
from boxwright.simulation import write_set


def percent(value: float | None) -> str:
    return "    -" if value is None else f"{value:5.1f}"


with tempfile.TemporaryDirectory() as folder:
    names = write_set(folder, count=6, seed=7)  # one frame of each category; same seed, same frames
    print(f"{len(names)} frames: {', '.join(names)}")
    summary = boxwright.evaluate(folder, method="paper")

print("category  flap %  full %  usable flaps %")
for figures in summary.categories:  # `all` comes last
    flap, full = percent(figures.flap_accuracy_percent), percent(figures.full_accuracy_percent)
    print(f"{figures.category:<10}{flap:>6}  {full:>6}  {percent(figures.usable_flaps_percent):>6}")
