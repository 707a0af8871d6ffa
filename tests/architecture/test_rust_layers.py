"""The core's modules use one another one way, and the sensor shares nothing with the core."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from support.repository import REPOSITORY, source_files

CORE = REPOSITORY / "core" / "src"


def test_the_order_is_stated_for_every_module() -> None:
    text = (CORE / "lib.rs").read_text(encoding="utf-8")
    assert sorted(_order()) == sorted(re.findall(r"^pub mod (\w+);", text, re.MULTILINE))


def test_modules_use_those_before_them() -> None:
    order = _order()
    wrong, counted = [], 0
    for path in source_files(".rs", CORE):
        room = _module_path(path)[:1]
        for used in _used_modules(path, set(order)) if room else ():
            counted += 1
            if order.index(used) > order.index(room[0]):
                wrong.append(f"{path.relative_to(REPOSITORY)}: {room[0]} uses crate::{used}, which comes after it")
    assert not wrong, "\n".join(wrong)
    assert counted > 60, "paths were overlooked"


def test_super_and_grouped_paths_are_followed() -> None:
    assert _paths("use crate::{error::Result, geometry};", ["model"]) == {"error", "geometry"}
    assert _paths("use crate::{\n    error::{InputError, Result},\n    geometry,\n};", ["model"]) >= {
        "error",
        "geometry",
    }
    assert _paths("use super::super::geometry::Plane;", ["model", "tables"]) == {"geometry"}
    assert _paths("use super::geometry::Plane;", ["pipeline"]) == {"geometry"}
    assert _paths("fn f() -> crate::error::Result<()> {}", ["model"]) == {"error"}
    assert _paths("use super::template::Template; // crate::geometry", ["model", "tables"]) == set()


def test_core_and_sensor_do_not_know_each_other() -> None:
    for crate, other in (("core", "sensor"), ("sensor", "core")):
        manifest = tomllib.loads((REPOSITORY / crate / "Cargo.toml").read_text(encoding="utf-8"))
        sections = ("dependencies", "dev-dependencies", "build-dependencies")
        needed = {name for section in sections for name in manifest.get(section, {})}
        assert f"boxwright-{other}" not in needed, f"{crate} depends on {other}"
        assert "pyo3" not in needed, f"{crate} knows Python"
        for path in source_files(".rs", REPOSITORY / crate):
            text = path.read_text(encoding="utf-8")
            assert f"boxwright_{other}" not in text, f"{path} names the crate {other}"
            assert not re.search(rf"(include!|path\s*=)[^\n]*/{other}/", text), f"{path} takes in a file of {other}"


def _order() -> list[str]:
    """The modules as core/src/lib.rs lists them, lowest first."""
    text = (CORE / "lib.rs").read_text(encoding="utf-8")
    comment = re.search(r"Layers, lowest first.*?\n((?://! `.*\n)+)", text)
    assert comment, "core/src/lib.rs no longer lists its layers"
    return re.findall(r"`(\w+)`", comment[1])


def _module_path(path: Path) -> list[str]:
    names = [*path.relative_to(CORE).parts[:-1], path.stem]
    return [name for name in names if name not in ("mod", "lib")]


def _used_modules(path: Path, modules: set[str]) -> set[str]:
    used = _paths(path.read_text(encoding="utf-8"), _module_path(path))
    return (used & modules) - set(_module_path(path)[:1])


def _paths(text: str, module_path: list[str]) -> set[str]:
    """First names of all paths from the crate's root: `crate::a`, `crate::{a, b}`, and `super::` up to the root."""
    code = re.sub(r"//[^\n]*", "", text)
    root = rf"(?:\bcrate::|(?<![\w:])(?:super::){{{len(module_path)}}})"
    names = set(re.findall(rf"{root}(\w+)", code)) - {"super"}
    for group in re.findall(rf"{root}\{{([^;]*)\}};", code):
        names |= set(re.findall(r"(?:^|,)\s*(\w+)", group))
    return names
