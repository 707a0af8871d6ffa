"""Simulated frames of the experiments, seen once by each front end. No training and no tuning used these seeds."""

from __future__ import annotations

from dataclasses import dataclass, replace

import msgspec
import numpy as np

from boxwright.evaluation.roles import FLAP, from_truth_name, kind_of
from boxwright.evaluation.verdicts import PANEL_READINGS
from boxwright.learning import SeenFrame
from boxwright.perception import perceive
from boxwright.simulation import CATEGORIES, Conditions, make_frame
from boxwright.simulation.conditions import DRAWN
from boxwright.types import Cloud, Truth

KINDS_SEED, TRAINING_SEED, TEST_SEED, SWEEP_SEED = 41000, 41001, 41002, 41003

Kind = tuple[str, str | None]
"""Category, and variant where it is not drawn."""
DRAWN_KINDS: tuple[Kind, ...] = tuple((category, None) for category in CATEGORIES)


@dataclass(frozen=True)
class Sequence:
    """An endless sequence of frames, the kinds in turn; frame i depends on nothing but this and i."""

    seed: int
    kinds: tuple[Kind, ...] = DRAWN_KINDS
    boxes: int | None = None
    clutter: bool = True
    conditions: Conditions = DRAWN

    def under(self, conditions: Conditions) -> Sequence:
        """The same boxes under other conditions."""
        return replace(self, conditions=conditions)

    def look(self, index: int) -> Look:
        """Frame `index` as both front ends see it."""
        category, variant = self.kinds[index % len(self.kinds)]
        conditions = msgspec.structs.replace(self.conditions, variant=variant)
        frame = make_frame(category, self.seed, index, boxes=self.boxes, clutter=self.clutter, conditions=conditions)
        cloud = Cloud(points=frame.points, width=frame.width, height=frame.height, viewpoint=(0.0, 0.0, 0.0))
        truth = frame.truth
        ransac, grid = (
            SeenFrame(truth.name, perceive(cloud, planes=planes), truth, frame.labels) for planes in ("ransac", "grid")
        )
        return Look(ransac, grid)


@dataclass(frozen=True, eq=False)
class Look:
    """One frame through the paper's front end and through the grid's."""

    ransac: SeenFrame
    grid: SeenFrame

    @property
    def truth(self) -> Truth:
        return self.ransac.truth


def distance_and_elevation(truth: Truth, box: int) -> tuple[float, float]:
    """Metres from the camera to the middle of a box's body, and degrees at which it is looked down on."""
    body = [p.corners for p in truth.parts if p.box == box and kind_of(from_truth_name(p.name)) in ("base", "side")]
    middle = np.mean(body, axis=(0, 1))
    distance_m = float(np.linalg.norm(middle))
    return distance_m, float(np.degrees(np.arcsin(-(middle @ np.array(truth.up)) / distance_m)))


def hidden_flaps(truth: Truth, box: int) -> int:
    """Flaps of a box with too few readings to count as a panel in the cloud."""
    flaps = [p for p in truth.parts if p.box == box and kind_of(from_truth_name(p.name)) == FLAP]
    return sum(p.visible_px < PANEL_READINGS for p in flaps)
