"""The same frames give the same weights, bit for bit, on one thread or two."""

from __future__ import annotations

from pathlib import Path

import pytest

from boxwright.evaluation import list_set, read_entry
from boxwright.io.clouds import read_cloud
from boxwright.learning import SeenFrame, train
from boxwright.models import LearnedWeights
from boxwright.perception import perceive
from boxwright.simulation import write_set
from support.learning_frames import carton


@pytest.fixture(scope="module")
def frames(tmp_path_factory: pytest.TempPathFactory) -> list[SeenFrame]:
    folder = tmp_path_factory.mktemp("set")
    write_set(folder, 4, 21, ("small", "medium"), boxes=1, clutter=False)
    seen = []
    for entry in list_set(folder):
        labelled = read_entry(entry)
        seen.append(SeenFrame(entry.name, perceive(read_cloud(entry.cloud_path)), labelled.truth, labelled.labels))
    return seen


def test_weights_do_not_depend_on_the_number_of_threads(frames: list[SeenFrame], tmp_path: Path) -> None:
    assert len(frames) == 4
    files = []
    for jobs in (1, 2, 2):
        learned: LearnedWeights = train(carton(), frames, command="made up", jobs=jobs)
        learned.save(tmp_path / "carton.json")
        files.append((tmp_path / "carton.json").read_bytes())
    assert files[0] == files[1] == files[2]
    assert learned.training is not None
    assert learned.training.frames == 4
    assert set(learned.weights) == set(learned.importance) == {*carton().feature_names, *carton().relation_names}
    assert any(learned.weights.values())
