"""The method fitted gives the same answer each time, on one thread or two."""

from __future__ import annotations

from pathlib import Path

from boxwright.evaluation import list_set
from boxwright.scoring import score_entries
from boxwright.simulation.sets import write_set


def test_threads_change_no_bit(tmp_path: Path) -> None:
    write_set(tmp_path, count=6, seed=77)
    entries = list_set(tmp_path)
    one, two, again = (
        [outcome.score for outcome in score_entries(entries, method="fitted", templates=None, weights=None, jobs=jobs)]
        for jobs in (1, 2, 2)
    )
    assert one == two == again
    assert sum(len(score.boxes) for score in one if score is not None) >= 6
