"""What a person types for a segment: "side_0", or "a.side_0" where a frame shows several boxes; "" for none."""

from __future__ import annotations

import re
from typing import NamedTuple

from boxwright import _core
from boxwright.evaluation.roles import to_truth_name
from boxwright.models import TEMPLATE_NAMES, load_template

BOX_NAME = re.compile(r"[A-Za-z0-9]+")


class Role(NamedTuple):
    """A part of a box; the box of a frame with one box has no name."""

    box: str
    part: str


def part_names(template: _core.Template) -> tuple[str, ...]:
    """The parts that a person can name. Raises ValueError for a template with a part that no truth can tell."""
    for part in template.parts:
        to_truth_name(part)
    return tuple(template.parts)


def read_role(text: str, template: _core.Template) -> Role | None:
    """The role that was typed, None for none. Raises ValueError with the roles that are known where it is not one."""
    typed = text.strip()
    if not typed:
        return None
    box, dot, part = typed.rpartition(".")
    if dot and BOX_NAME.fullmatch(box) is None:
        raise ValueError(f"role {typed!r}: {box!r} is no box's name; must be letters and digits, as in 'a.{part}'")
    known = part_names(template)
    if part not in known:
        raise ValueError(f"role {typed!r}: {_why(part, template)}; known are {', '.join(known)}")
    return Role(box, part)


def _why(part: str, template: _core.Template) -> str:
    for name in TEMPLATE_NAMES:
        if name != template.name and part in load_template(name).parts:
            return f"{part!r} is a part of {name}, not of {template.name}"
    return f"{template.name} has no part {part!r}"
