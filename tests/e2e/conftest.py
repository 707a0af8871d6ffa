"""A small scene set and weights that need no learning."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from boxwright.models import load_template
from boxwright.simulation import write_set

SEED = 5


@pytest.fixture(scope="session")
def scene_set(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three simulated frames: small, medium, large."""
    folder = tmp_path_factory.mktemp("sets") / "three"
    assert len(write_set(folder, 3, SEED, ("small", "medium", "large"), boxes=1)) == 3
    return folder


@pytest.fixture(scope="session")
def frame(scene_set: Path) -> Path:
    """The cloud of the first frame."""
    return scene_set / "small_0000.pcd"


@pytest.fixture(scope="session")
def weights(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every term of the carton counts 1: these tests are about commands, not about how good the answers are."""
    template = load_template("carton")
    ones = dict.fromkeys(template.feature_names + template.relation_names, 1.0)
    path = tmp_path_factory.mktemp("weights") / "ones.json"
    content = {"format": "boxwright.weights", "version": 1, "template": "carton", "accept_score": 3.0}
    path.write_text(json.dumps(content | {"weights": ones, "importance": ones}))
    return path


@pytest.fixture(scope="session")
def carton(weights: Path) -> tuple[str, ...]:
    """Options that look for cartons by those weights."""
    return ("--method", "paper", "--template", "carton", "--weights", str(weights))
