"""The true planes of a frame: box panels, and flat faces of everything else."""

from __future__ import annotations

from dataclasses import dataclass

from boxwright.types import TruePart, Truth

ROLES = ("base", "side", "flap", "tuck", "pair")
"""Of panels; a pair is a flap that lies in its side's plane, and that side."""
PAIR_LEAN_DEG = 10.0


@dataclass(frozen=True)
class TruePlane:
    """A panel, or a pair of panels: its name with its box's number, and the numbers of its faces (docs/formats.md)."""

    name: str
    role: str
    faces: tuple[int, ...]


def panels_apart(truth: Truth) -> list[TruePlane]:
    """Each panel by itself."""
    return [_panel(truth, k) for k in range(len(truth.parts))]


def panels_paired(truth: Truth) -> list[TruePlane]:
    """A flap within 10 degrees of its side's plane and that side are one plane; else as `panels_apart`."""
    index = {(part.box, part.name): k for k, part in enumerate(truth.parts)}
    partner = {
        index[part.box, part.parent]: k
        for k, part in enumerate(truth.parts)
        if part.parent is not None and lies_in_its_sides_plane(part)
    }
    flaps = set(partner.values())
    planes = []
    for k in range(len(truth.parts)):
        if k in partner:
            side, flap = _panel(truth, k), _panel(truth, partner[k])
            planes.append(TruePlane(f"{side.name}+{flap.name.split(':')[1]}", "pair", side.faces + flap.faces))
        elif k not in flaps:
            planes.append(_panel(truth, k))
    return planes


def lies_in_its_sides_plane(part: TruePart) -> bool:
    """A flap stands in its side's plane at 90 degrees, and hangs along it at 270 (and inside at -90)."""
    if not part.name.startswith("flap") or part.angle_deg is None:
        return False
    return abs(part.angle_deg % 180.0 - 90.0) <= PAIR_LEAN_DEG


def _panel(truth: Truth, k: int) -> TruePlane:
    part = truth.parts[k]
    return TruePlane(f"{part.box}:{part.name}", part.name.rstrip("0123456789"), (k + 1,))
