"""docs/maths.md numbers every formula once, and the code cites numbers that are there."""

from __future__ import annotations

import re

from support.repository import REPOSITORY, source_files

PAGE = REPOSITORY / "docs" / "maths.md"

CITED = re.compile(r"\beqs?\.[ \n]+(?P<first>\d+)(?:-(?P<last>\d+))?")


def test_formulas_are_numbered_in_order() -> None:
    text = PAGE.read_text(encoding="utf-8")
    numbers = [int(number) for number in re.findall(r"\\tag\{(\d+)\}", text)]
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) > 30
    assert text.count("$$") == 2 * len(numbers), "each display formula bears one number"


def test_the_code_cites_numbers_that_are_there() -> None:
    known = PAGE.read_text(encoding="utf-8").count(r"\tag{")
    wrong, cited = [], set()
    for path in [file for suffix in (".rs", ".py", ".pyi") for file in source_files(suffix)]:
        for match in CITED.finditer(path.read_text(encoding="utf-8")):
            first, last = int(match["first"]), int(match["last"] or match["first"])
            cited |= set(range(first, last + 1))
            if not 1 <= first <= last <= known:
                wrong.append(f"{path.relative_to(REPOSITORY)}: {match[0]}")
    assert not wrong, "\n".join(wrong)
    assert len(cited) > 30, "citations were overlooked"


def test_files_that_the_page_names_exist() -> None:
    named = re.findall(r"`((?:core|src)/[\w/]+(?:/|\.rs|\.py))`", PAGE.read_text(encoding="utf-8"))
    missing = [name for name in named if not (REPOSITORY / name).exists()]
    assert not missing, ", ".join(missing)
    assert len(named) > 8
