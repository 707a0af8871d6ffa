"""The rooms of the package import one way: down."""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

from support.imports import FACE, core_names, imported_room, imports_of, room_of
from support.repository import PACKAGE, REPOSITORY, source_files

LAYERS = (
    ("types", "parallel", "_core"),
    ("io",),
    ("perception", "models", "kinematics"),
    ("evaluation", "robots"),
    ("learning", "planning"),
    ("segmentation", "replanning"),
    ("pipeline",),
    ("fusion",),
    ("answers", "scoring", "kinds", "labelling", "runner_up"),
    ("figures",),
    (FACE,),
    ("cli",),
)
"""Lowest first. A room uses those of lower layers and itself, not its neighbours."""

SIMULATION_USES = {"types", "io", "parallel", "_core"}
"""Beside the layers: what makes frames shares nothing with what understands them, so that errors cannot cancel."""

ONLY_IN = {
    "typer": {"cli"},
    "rich": {"cli"},
    "matplotlib": {"figures"},
    "mcap_ros2": {"io"},
    "mujoco": {"simulation"},
    "PIL": {"simulation"},
    "scipy": set(),
    "sklearn": {"learning"},
}
"""Rooms that may import what is slow to import or an extra; `infer` needs numpy alone."""

MODULE_OF = {"mcap-ros2-support": "mcap_ros2", "pyyaml": "yaml", "pillow": "PIL", "scikit-learn": "sklearn"}

RANK = {room: rank for rank, rooms in enumerate(LAYERS) for room in rooms}


def test_every_room_has_its_layer() -> None:
    rooms = {room_of(path) for path in source_files(".py", PACKAGE)}
    unknown = rooms - RANK.keys() - {"simulation"}
    assert not unknown, f"{unknown}: say in LAYERS which layer a new room belongs to"
    gone = RANK.keys() - rooms - {"_core"}
    assert not gone, f"{gone}: LAYERS names rooms that are not there"


def test_imports_go_down() -> None:
    wrong, counted = [], 0
    for path, line, room, used in _inner_imports():
        counted += 1
        if "simulation" in (room, used):
            allowed = used in SIMULATION_USES if room == "simulation" else room in ("cli", FACE)
        else:
            allowed = RANK[used] < RANK[room]
        if not allowed:
            wrong.append(f"{path.relative_to(REPOSITORY)}:{line}: {room} imports {used}")
    assert not wrong, "\n".join(wrong)
    assert counted > 100, "imports were overlooked"


def test_simulation_uses_the_sensor_alone_of_the_core() -> None:
    stub = (PACKAGE / "_core.pyi").read_text(encoding="utf-8")
    sections = dict(re.findall(r"^# --- (\w+) ---$(.*?)(?=^# ---|\Z)", stub, re.MULTILINE | re.DOTALL))
    sensor = set(re.findall(r"^(?:def|class) (\w+)", sections["sensor"], re.MULTILINE))
    used = {name for path in source_files(".py", PACKAGE / "simulation") for name in core_names(path)}
    assert used <= sensor, f"simulation uses {used - sensor} of the core; it shares nothing with perception"
    assert used


def test_what_is_imported_is_declared() -> None:
    declared = _declared_modules()
    wrong, counted = [], 0
    for path in source_files(".py", PACKAGE):
        for item in imports_of(path):
            module = item.module.split(".")[0]
            if module == "boxwright" or module in sys.stdlib_module_names:
                continue
            counted += 1
            if module not in declared:
                wrong.append(f"{path.relative_to(REPOSITORY)}:{item.line}: {module} is no dependency in pyproject.toml")
            elif room_of(path) not in ONLY_IN.get(module, {room_of(path)}):
                wrong.append(f"{path.relative_to(REPOSITORY)}:{item.line}: {module} has no place in {room_of(path)}")
    assert not wrong, "\n".join(wrong)
    assert counted > 50, "imports were overlooked"


def _inner_imports() -> list[tuple[Path, int, str, str]]:
    """File, line, its room and the other room that it imports."""
    found = []
    for path in source_files(".py", PACKAGE):
        for item in imports_of(path):
            used = imported_room(item.module)
            if used is not None and used != room_of(path):
                found.append((path, item.line, room_of(path), used))
    return found


def _declared_modules() -> set[str]:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = [item for items in project["optional-dependencies"].values() for item in items]
    names = [re.split(r"[<>=!~\[; ]", item)[0].lower() for item in project["dependencies"] + extras]
    return {MODULE_OF.get(name, name) for name in names}
