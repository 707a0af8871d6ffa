"""The repository's own files, for tests that hold its shape."""

from __future__ import annotations

import subprocess
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
PACKAGE = REPOSITORY / "src" / "boxwright"

_GENERATED = {".git", ".venv", "target", "dist", "out", "__pycache__"}
_CACHES = {".pytest_cache", ".ruff_cache", ".mypy_cache", ".hypothesis"}
_BINARY_SUFFIXES = {".png", ".npz", ".npy", ".pcd", ".ply", ".so"}


def source_files(suffix: str, folder: Path = REPOSITORY) -> list[Path]:
    """Files of a suffix that are kept in the repository, sorted."""
    return [path for path in kept_files() if path.suffix == suffix and path.is_relative_to(folder)]


def text_files() -> list[Path]:
    """Files that people write and read, sorted."""
    return [path for path in kept_files() if path.suffix not in _BINARY_SUFFIXES and "seeds" not in path.parts]


def kept_files() -> list[Path]:
    """Files that git keeps or would keep; in an unpacked archive, all but what is generated."""
    listed = subprocess.run(
        ["git", "-c", f"safe.directory={REPOSITORY}", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=REPOSITORY,
        capture_output=True,
        check=False,
    )
    if listed.returncode == 0:
        names = listed.stdout.decode().split("\0")[:-1]
        paths = (REPOSITORY / name for name in names)
    else:
        paths = (path for path in REPOSITORY.rglob("*") if not {*path.parts} & (_GENERATED | _CACHES))
    return sorted(path for path in paths if path.is_file())
