"""One trajectory against one box, from start to verdict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from typing import Any, Literal

import msgspec
import numpy as np

from boxwright.simulation.physics.boards import BoardBox
from boxwright.simulation.physics.creases import crease_class
from boxwright.simulation.physics.session import Load, Session
from boxwright.simulation.physics.settings import PhysicsSettings
from boxwright.simulation.physics.stage import Film
from boxwright.simulation.physics.world import Tool, World
from boxwright.types import PlanSegment, Simulation

CREASE = "ordinary"
"""The class of creases of whoever names none."""


class Run(msgspec.Struct, frozen=True, eq=False):
    """The verdict; the box as it stands in the end; the film (empty unless stills were asked for) and its world."""

    simulation: Simulation
    box: BoardBox
    film: Film
    world: World


def run_of(session: Session, crease: str, kind: Literal["inferred", "true"]) -> Run:
    """What has become of a session's box until now; `crease` and `kind` are the names under which it is told."""
    return Run(session.verdict(crease, kind), session.box_now(), session.stage.film, session.stage.world)


def simulate_closing(
    box: BoardBox,
    tool: Tool,
    segments: Sequence[PlanSegment],
    crease: str = CREASE,
    *,
    kind: Literal["inferred", "true"] = "true",
    crease_file: str | PathLike[str] | None = None,
    settings: PhysicsSettings | None = None,
    load: Load | None = None,
    others: Sequence[BoardBox] = (),
    scene: Sequence[Mapping[str, Any]] = (),
    stills_per_s: float = 0.0,
) -> Run:
    """Follow a plan's segments with a tool and say what became of the box. Same arguments, same bits, but the seconds.

    All is in the tool's base frame (m, rad). `others` are boxes that stay where they are, `scene` what else stands
    around (things.py).

    Raises ValueError when there is no segment, the load is none, or the crease is not known; OSError for its file.
    """
    if not segments:
        raise ValueError("there is no segment to follow; a plan that closes no flap has no motion")
    session = Session(
        box,
        tool,
        np.array(segments[0].positions[0]),
        crease_class(crease, crease_file),
        opening_m=segments[0].gripper_opening_m,
        settings=settings,
        load=load,
        others=others,
        scene=scene,
        stills_per_s=stills_per_s,
    )
    session.follow(segments)
    return run_of(session, crease, kind)
