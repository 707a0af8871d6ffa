"""Options that tell what is known of the boxes in view, and what they come to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from boxwright.cli.options import MODEL
from boxwright.cli.values import OuterSize

if TYPE_CHECKING:
    from boxwright.types import KnownSize

SizeOption = Annotated[
    list[OuterSize] | None,
    typer.Option(
        "--size",
        parser=OuterSize.parse,
        metavar="LxWxH",
        help="Outer size in mm that a box in view has, in any order, e.g. 400x300x200; repeatable. --method fitted.",
        rich_help_panel=MODEL,
    ),
]
CatalogueOption = Annotated[
    Path | None,
    typer.Option(
        "--catalogue",
        metavar="FILE.toml",
        help="Outer sizes that boxes in view may have (docs/formats.md). --method fitted.",
        rich_help_panel=MODEL,
    ),
]


@dataclass(frozen=True)
class KnownOptions:
    """What is known of the boxes in view."""

    size: SizeOption = None
    catalogue: CatalogueOption = None

    def sizes(self, method: str) -> tuple[KnownSize, ...]:
        """The outer sizes given, those of the command line first.

        Raises typer.BadParameter where the method knows no sizes, and as `read_sizes` does.
        """
        from boxwright.io.sizes import known_size, read_sizes

        if (self.size or self.catalogue) and method != "fitted":
            raise typer.BadParameter(f"method {method!r} knows no sizes; add --method fitted", param_hint="--size")
        typed = tuple(known_size(f"{size.text} mm", size.outer_mm) for size in self.size or ())
        return typed + (read_sizes(self.catalogue) if self.catalogue else ())
