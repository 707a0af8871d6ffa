"""What a Python file imports, imports inside functions included."""

from __future__ import annotations

import ast
from dataclasses import dataclass
from pathlib import Path

from support.repository import PACKAGE

FACE = "__init__"
"""The room of `boxwright/__init__.py`, the public face."""


@dataclass(frozen=True)
class Import:
    """`line` of a file imports `module`; `from module import name` is `module.name` where that is a module."""

    line: int
    module: str


def room_of(path: Path) -> str:
    """The room of a file of the package: the first name below `boxwright`."""
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imported_room(module: str) -> str | None:
    """The room that an imported module lies in; None where it is not ours."""
    names = module.split(".")
    if names[0] != "boxwright":
        return None
    return names[1] if len(names) > 1 else FACE


def imports_of(path: Path) -> list[Import]:
    """Every import of a file. Raises AssertionError at a relative or dynamic one, which no layer test could follow."""
    found = []
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
        if isinstance(node, ast.Import):
            found += [Import(node.lineno, alias.name) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}:{node.lineno}: relative import; name the module in full"
            found += [Import(node.lineno, _module(str(node.module), alias.name)) for alias in node.names]
        elif isinstance(node, ast.Call) and path != PACKAGE / "__init__.py":
            called = ast.unparse(node.func)
            assert called not in ("__import__", "import_module", "importlib.import_module"), (
                f"{path}:{node.lineno}: dynamic import; only the public face may be lazy that way"
            )
    return found


def core_names(path: Path) -> set[str]:
    """Names of the compiled core that a file uses."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "_core":
            names.add(node.attr)
        elif isinstance(node, ast.ImportFrom) and node.module == "boxwright._core":
            names |= {alias.name for alias in node.names}
    return names


def _module(module: str, name: str) -> str:
    """`from boxwright import io` imports a room, `from boxwright import infer` the public face."""
    is_room = (PACKAGE / name).is_dir() or (PACKAGE / f"{name}.py").exists() or (PACKAGE / f"{name}.pyi").exists()
    return f"{module}.{name}" if module == "boxwright" and is_room else module
