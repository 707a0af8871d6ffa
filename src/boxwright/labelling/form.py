"""The form: a TOML file with one line for each segment, in which a person types roles."""

from __future__ import annotations

import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import msgspec
import numpy as np

from boxwright import _core
from boxwright.labelling.roles import part_names
from boxwright.segmentation import size_m, tilt_deg
from boxwright.types import Segment, Segmentation
from boxwright.types.segments import BACKGROUND

HEAD = """\
# What is each segment of {cloud}? Look at {picture}: each has its number there.
# Type a segment's role between its quotes, then give the same command again.
#
# Roles: {parts}.
# - "" where a segment is none of these: floor, table, things, a panel that the list does not have.
# - A panel that lies there in several pieces: its role on each piece.
# - Several boxes: a name and a dot before the part: "a.side_0", "b.side_0".
# - Where a segment holds two panels, give it the one that has most of it.
"""

SIDES = """\
# - Sides are numbered counter-clockwise seen from above, from any of them; flap_0 hangs on side_0, flap_1 on side_1.
"""


class _FormFile(msgspec.Struct, kw_only=True):
    format: Literal["boxwright.roles"]
    version: Literal[1]
    cloud: str
    points: int
    template: str
    category: str
    roles: dict[str, str]


@dataclass(frozen=True)
class Form:
    """A form as it was read: `roles` as typed, by segment, and the line that each stands on."""

    path: Path
    points: int
    template: str
    category: str
    roles: dict[int, str]
    lines: dict[int, int]

    @property
    def is_empty(self) -> bool:
        """True when no role was typed."""
        return not any(text.strip() for text in self.roles.values())

    def place(self, segment: int) -> str:
        """Where a segment's role stands."""
        return f"{self.path}: line {self.lines[segment]}"


def form_text(
    segmentation: Segmentation,
    template: _core.Template,
    category: str,
    picture: str,
    roles: Mapping[int, str] | None = None,
) -> str:
    """The form of a cloud's segments; `roles` are those known already. Sizes and heights in millimetres, degrees."""
    source = segmentation.source
    parts = part_names(template)
    head = HEAD.format(cloud=source.file, picture=picture, parts=", ".join(parts))
    if "side_0" in parts:
        head += SIDES
    keys = {
        "format": "boxwright.roles",
        "version": 1,
        "cloud": source.file,
        "points": source.points,
        "template": template.name,
        "category": category,
    }
    typed = [_quoted((roles or {}).get(k, "")) for k in range(len(segmentation.segments))]
    wide = max(map(len, typed), default=0)
    lines = [
        f"{k:<2} = {text:<{wide}}  # {describe(segment, segmentation)}"
        for k, (text, segment) in enumerate(zip(typed, segmentation.segments, strict=True))
    ]
    told = [f"{key} = {_quoted(value)}" for key, value in keys.items()]
    return "\n".join([head, *told, "", "[roles]", *lines, ""])


def describe(segment: Segment, segmentation: Segmentation) -> str:
    """Readings, size, height of the middle above the support and tilt (0 level, 90 upright) of a segment."""
    long_m, short_m = sorted(size_m(segment), reverse=True)
    words = [f"{segment.points} readings", f"{1000 * long_m:.0f} x {1000 * short_m:.0f} mm"]
    support = segmentation.support_plane
    if support is not None:
        height_m = float(np.mean(segment.rectangle, axis=0) @ np.array(support.normal)) - support.distance
        words.append(f"{round(1000 * height_m)} mm above the support")
    words.append(f"tilt {tilt_deg(segment, segmentation.up):.0f} deg")
    if segment.group == BACKGROUND:
        words.append("background")
    return ", ".join(words)


def read_form(path: Path) -> Form:
    """Read a form. Raises OSError when it cannot be read, ValueError naming file and line or key where it is wrong."""
    try:
        text = path.read_text(encoding="utf-8")
        content = msgspec.convert(tomllib.loads(text), _FormFile)
    except UnicodeDecodeError as error:
        raise ValueError(f"{path}: byte {error.start}: is not UTF-8 text") from None
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise ValueError(f"{path}: {error}") from None
    lines = {key: _line_of(key, text) for key in content.roles}
    for key in content.roles:
        if not key.isdecimal():
            raise ValueError(f"{path}: line {lines[key]}: {key!r} is no segment's number")
    return Form(
        path=path,
        points=content.points,
        template=content.template,
        category=content.category,
        roles={int(key): text for key, text in content.roles.items()},
        lines={int(key): line for key, line in lines.items()},
    )


def _line_of(key: str, text: str) -> int:
    """The line on which a key of the table of roles stands; that table comes last."""
    start = text.index("[roles]") if "[roles]" in text else 0
    found = re.compile(rf"""^\s*["']?{re.escape(key)}["']?\s*=""", re.MULTILINE).search(text, start)
    return text.count("\n", 0, found.end()) + 1 if found else text.count("\n", 0, start) + 1


def _quoted(value: object) -> str:
    return json.dumps(value, ensure_ascii=False)
