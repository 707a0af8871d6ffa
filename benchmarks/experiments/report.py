"""What an experiment says, and its files: NAME.md with tables and picture, NAME.json with the figures, NAME.png."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.figure import Figure

Cell = str | int | float | None

DPI = 100
STYLE = {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.alpha": 0.3,
    "font.size": 9,
    "legend.frameon": False,
    "axes.prop_cycle": plt.cycler(color=["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"]),
}
"""Colours that the colour-blind tell apart (Okabe and Ito)."""


@dataclass(frozen=True)
class Table:
    """Cells are text or numbers; numbers that are not whole are told with `digits` behind the point."""

    title: str
    columns: tuple[str, ...]
    rows: Sequence[tuple[Cell, ...]]
    digits: int = 1


@dataclass(frozen=True)
class Report:
    """`claim` is what the paper says, `how` what was done here; `draw` fills a figure of a size in inches."""

    title: str
    claim: str
    how: str
    tables: tuple[Table, ...]
    draw: Callable[[Figure], None]
    size_in: tuple[float, float] = (8.0, 3.6)


def write(report: Report, name: str, folder: Path, command: str) -> None:
    """Writes the three files."""
    folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        figure = plt.figure(figsize=report.size_in, layout="constrained")
        report.draw(figure)
        figure.savefig(folder / f"{name}.png", dpi=DPI, metadata={"Software": None})
        plt.close(figure)
    content = {
        "experiment": name,
        "command": command,
        "tables": [{"title": t.title, "columns": t.columns, "rows": _rounded(t.rows)} for t in report.tables],
    }
    (folder / f"{name}.json").write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")
    (folder / f"{name}.md").write_text(_markdown(report, name, command), encoding="utf-8")


def _markdown(report: Report, name: str, command: str) -> str:
    lines = [f"# {report.title}", "", f"`{command}`", "", f"The paper: {report.claim}", "", report.how]
    for table in report.tables:
        lines += ["", table.title, "", *_rows(table)]
    return "\n".join([*lines, "", f"![{report.title}]({name}.png)", ""])


def _rows(table: Table) -> list[str]:
    def text(cell: Cell) -> str:
        if cell is None:
            return "-"
        return f"{cell:.{table.digits}f}" if isinstance(cell, float) else str(cell)

    rule = ["---", *["---:"] * (len(table.columns) - 1)]
    return ["| " + " | ".join(row) + " |" for row in (table.columns, rule, *(map(text, row) for row in table.rows))]


def _rounded(rows: Sequence[tuple[Cell, ...]]) -> list[list[Cell]]:
    return [[round(cell, 6) if isinstance(cell, float) else cell for cell in row] for row in rows]
