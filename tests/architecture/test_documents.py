"""What the documents say is there, and nothing of the machine that they were written on."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib

from support.repository import REPOSITORY, source_files, text_files

PLAN = REPOSITORY / "docs" / "formats.md"
"""Covers the whole plan, commands to come included."""

MACHINE_PATH = re.compile(r"(?<![\w./<>$)}-])/(?:home|root|work|opt|mnt|srv|tmp|Users)/[\w.]")
"""A path that starts at a machine's root; `https://host/work/` and `$HOME/work` do not."""


def test_no_file_names_a_place_on_someones_machine() -> None:
    files = text_files()
    wrong = [
        f"{path.relative_to(REPOSITORY)}:{number}: {line.strip()}"
        for path in files
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if MACHINE_PATH.search(line)
    ]
    assert not wrong, "\n".join(wrong)
    assert len(files) > 150, "files were overlooked"


def test_the_machine_path_rule_tells_paths_from_addresses() -> None:
    for place in ("/home", "/work", "/tmp"):
        assert MACHINE_PATH.search(f"see {place}/me/x.pcd")
        assert not MACHINE_PATH.search(f"https://example.org{place}/x, $HOME{place}/x, out{place}/x")


def test_only_the_fixture_knows_where_shared_data_lies() -> None:
    name = "BOXWRIGHT_SHARED"
    places = {path.relative_to(REPOSITORY).as_posix() for path in source_files(".py") if name in path.read_text()}
    assert "tests/conftest.py" in places
    outside = {path for path in places if not path.startswith(("tests/", "benchmarks/"))}
    assert not outside, f"{outside}: the program knows no such data"


def test_the_readme_is_short() -> None:
    lines = (REPOSITORY / "README.md").read_text(encoding="utf-8").splitlines()
    assert len(lines) < 150


def test_links_between_documents_lead_somewhere() -> None:
    wrong, counted = [], 0
    for page in source_files(".md"):
        for target in re.findall(r"\]\(([^)#\s]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            if "://" in target or target.startswith("mailto:"):
                continue
            counted += 1
            if not (page.parent / target).exists():
                wrong.append(f"{page.relative_to(REPOSITORY)}: {target}")
    assert not wrong, "\n".join(wrong)
    assert counted > 2, "links were overlooked"


def test_commands_and_targets_in_documents_exist() -> None:
    commands, targets = _commands(), _make_targets()
    wrong, counted = [], 0
    for page in source_files(".md"):
        for code in _code_spans(page.read_text(encoding="utf-8")):
            named = re.findall(r"(?:^|[\s(/])boxwright ([a-z]+)\b(?!:)", code) if page != PLAN else []
            made = re.findall(r"(?:^|\s)make ([a-z]+)\b", code)
            counted += len(named) + len(made)
            wrong += [f"{page.name}: boxwright {name}" for name in named if name not in commands]
            wrong += [f"{page.name}: make {name}" for name in made if name not in targets]
    assert not wrong, "\n".join(wrong)
    assert counted > 10, "commands were overlooked"


def test_the_version_is_one() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    cargo = tomllib.loads((REPOSITORY / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]
    said = subprocess.run(
        [sys.executable, "-c", "from boxwright.cli import main; main()", "--version"],
        capture_output=True,
        text=True,
        check=True,
    ).stdout.strip()
    assert project == cargo
    assert said == f"boxwright {project}"
    assert project in (REPOSITORY / "CHANGELOG.md").read_text(encoding="utf-8")


def _code_spans(text: str) -> list[str]:
    fenced = re.findall(r"^```[^\n]*\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    rest = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return [line for block in fenced for line in block.splitlines()] + re.findall(r"`([^`\n]+)`", rest)


def _commands() -> set[str]:
    import typer.main

    from boxwright.cli.app import app

    return set(typer.main.get_command(app).commands)  # type: ignore[attr-defined]


def _make_targets() -> set[str]:
    text = (REPOSITORY / "Makefile").read_text(encoding="utf-8")
    return set(re.findall(r"^([a-z]+):", text, re.MULTILINE))
