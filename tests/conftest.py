"""What every test may ask for."""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def shared_dir() -> Path:
    """The folder with the shared data: BOXWRIGHT_SHARED, else `shared` beside the repository; skips where missing."""
    named = os.environ.get("BOXWRIGHT_SHARED")
    folder = Path(named) if named else Path(__file__).resolve().parents[2] / "shared"
    if not folder.is_dir():
        pytest.skip(f"no shared data at {folder}; BOXWRIGHT_SHARED names its folder")
    return folder
