"""Roles asked for on the terminal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from boxwright import _core
from boxwright.cli.screen import console
from boxwright.labelling import Form, describe, part_names, read_role
from boxwright.types import Segmentation

NONE = "-"
"""Typed for "no role" where a segment has one already."""


def ask_roles(
    form: Form,
    segmentation: Segmentation,
    template: _core.Template,
    picture: Path,
    keep: Callable[[dict[int, str]], None],
) -> None:
    """Asks for each segment's role; Enter keeps what the form says. Every answer is kept at once.

    Raises ValueError where the answers end before the segments do.
    """
    out = console()
    out.print(f"[bold]{segmentation.source.file}[/]: look at {picture}", soft_wrap=True)
    out.print(f"roles: {', '.join(part_names(template))}; several boxes: a.side_0, b.side_0", soft_wrap=True)
    out.print(f"Enter: as it is, at first none; {NONE}: none")
    roles = dict(form.roles)
    for k, segment in enumerate(segmentation.segments):
        now = roles.get(k, "")
        try:
            roles[k] = _asked(f"{k}: {describe(segment, segmentation)}\n   role [{now or 'none'}]: ", now, template)
        except EOFError:
            raise ValueError(
                f"{form.path}: the answers ended at segment {k} of {len(segmentation.segments)}; earlier ones are kept"
            ) from None
        keep(roles)
    out.print()


def _asked(question: str, now: str, template: _core.Template) -> str:
    """One role; asked again until it is one."""
    out = console()
    while True:
        typed = out.input(question, markup=False).strip()
        if not typed:
            return now
        if typed == NONE:
            return ""
        try:
            read_role(typed, template)
        except ValueError as error:
            out.print(str(error), soft_wrap=True, markup=False)
        else:
            return typed
