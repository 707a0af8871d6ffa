"""What every export tells of an object: a solid link for each panel that has corners, hung on one root."""

from __future__ import annotations

import msgspec
import numpy as np

from boxwright.kinematics.links import corners_of, link_frames, panel_frame, root_part
from boxwright.kinematics.plates import EnclosingBox, Plate, enclosing_box, plate
from boxwright.kinematics.transforms import Matrix, apply, inverse, rigid
from boxwright.types import Joint, Object
from boxwright.types.board import BOARD_G_PER_M2, BOARD_THICKNESS_M


class SolidLink(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """A panel's link: its frame (links.py), the panel's mass in it, and the box around the panel."""

    name: str
    input_from_link: Matrix
    body: Plate
    box: EnclosingBox
    link_from_box: Matrix


class Solids(msgspec.Struct, frozen=True, eq=False, kw_only=True):
    """All links in the order of the parts, the root's name, the joints by the part that turns, and the board."""

    root: str
    links: dict[str, SolidLink]
    joint_of: dict[str, Joint]
    board_g_per_m2: float
    thickness_m: float
    thickness_told: bool

    def frames(self) -> dict[str, Matrix]:
        """input_from_link of every link."""
        return {name: link.input_from_link for name, link in self.links.items()}


def solids_of(
    model_object: Object,
    root: str | None = None,
    board_g_per_m2: float = BOARD_G_PER_M2,
    board_thickness_m: float = BOARD_THICKNESS_M,
) -> Solids:
    """An object's links: metres, kilograms, hung on `root` (default: the base, else the first fixed part).

    `board_thickness_m` counts only where the object tells no thickness. Raises ValueError when no part can be the root,
    a panel has no area, or the board is none.
    """
    if board_g_per_m2 <= 0.0 or board_thickness_m <= 0.0:
        raise ValueError(f"board weighs {board_g_per_m2} g/m2, is {board_thickness_m} m thick; both must be above 0")
    hung_on = root_part(model_object, root)
    frames = link_frames(model_object, hung_on)
    thickness_m = model_object.thickness or board_thickness_m
    return Solids(
        root=hung_on,
        links={
            name: _solid(name, frames[name], corners, board_g_per_m2, thickness_m)
            for name, corners in corners_of(model_object).items()
        },
        joint_of={joint.child: joint for joint in model_object.joints},
        board_g_per_m2=board_g_per_m2,
        thickness_m=thickness_m,
        thickness_told=bool(model_object.thickness),
    )


def numbers(values: Matrix | tuple[float, ...]) -> str:
    """Numbers as the shortest text that reads back as the same bits."""
    return " ".join(repr(float(value)) for value in values)


def _solid(name: str, frame: Matrix, corners: Matrix, board_g_per_m2: float, thickness_m: float) -> SolidLink:
    """`frame` is input_from_link, corners (4, 3) are in the input's frame."""
    panel = panel_frame(name, corners)
    link_from_panel = inverse(frame) @ panel
    box = enclosing_box(apply(inverse(panel), corners), thickness_m)
    return SolidLink(
        name=name,
        input_from_link=frame,
        body=plate(apply(inverse(frame), corners), link_from_panel[:3, 2], board_g_per_m2, thickness_m),
        box=box,
        link_from_box=link_from_panel @ rigid(np.eye(3), box.centre),
    )
