"""What physics assumes beside box, robot and crease. Every figure is an assumption unless its line says otherwise."""

from __future__ import annotations

import msgspec

from boxwright.types.board import BOARD_G_PER_M2
from boxwright.types.checks import require_positive

SHORTEST_STEP_S, LONGEST_STEP_S = 0.00005, 0.001
"""Shorter steps take a run hours and tell nothing more."""


class PhysicsSettings(msgspec.Struct, frozen=True, kw_only=True):
    """Settings of a run. Contacts are soft constraints of MuJoCo's: `contact_time_s` is the time constant (solref) in
    which a penetration is undone, critically damped; it has to be twice the time step or more. There is no margin:
    contacts push from the moment that surfaces meet.
    """

    time_step_s: float = 0.001
    contact_time_s: float = 0.002
    contact_impedance: float = 0.99
    """How much of a contact is constraint and how little is give (solimp, the same at every depth)."""
    friction_board: float = 0.4
    """Board on board, on the support and on a finger; the larger of two surfaces' counts."""
    friction_support: float = 0.4
    friction_finger: float = 0.4
    board_g_per_m2: float = BOARD_G_PER_M2
    contents_kg_per_m3: float = 100.0
    """What fills a box that is not empty weighs this for its volume: a pizza half a kilogram, a large carton ten."""
    sheet_m: float = 0.002
    sheet_ends_m: float = 0.015
    sheet_friction: float = 0.3
    """Flaps meet other flaps as sheets this thick (box_bodies.py): inner flaps without what is this near to their ends,
    where board bends and rims bulge in a real box; stiff boards jam in corners where cartons do not."""
    crease_relaxation_s: float = 0.01
    """Fibres take energy from a flap that swings: the crease's damping is its stiffness times this."""
    edge_kg: float = 0.02
    """Flaps are as slow as if this sat on their free edge, and not heavier: boards of a few grams between a crease and
    a contact, both stiff, would chatter. A flap that turns by 1 rad/s at 0.2 m takes 0.4 mJ of it."""
    gravity_m_per_s2: float = 9.80665
    settle_s: float = 0.5
    """Before the arm moves, everything comes to rest; flaps are measured then."""
    rest_s: float = 2.0
    """After the arm has retreated, before a flap is judged (docs/formats.md)."""
    worst_penetration_m: float = 0.001
    """A run in which anything sinks deeper into anything else proves nothing."""
    most_force_n: float = 250.0
    """The tool is stopped where it presses harder than this on anything, felt as `Watch` feels it, as a controller that
    watches its motors' currents would stop it: five times what an arm of 5 kg payload holds up. Nearly all runs in
    which all goes well stay below it, lids that are pressed onto their tucks being the most; those that drag a box do
    not."""
    tripped_m: float = 0.0005
    """Two boards that start deeper in one another than this were not told apart by whoever told them."""

    def __post_init__(self) -> None:
        for name in self.__struct_fields__:
            require_positive(name, [getattr(self, name)])
        if not SHORTEST_STEP_S <= self.time_step_s <= LONGEST_STEP_S:
            raise ValueError(
                f"time_step_s is {self.time_step_s:g}; it must be {LONGEST_STEP_S} or less, "
                f"and {SHORTEST_STEP_S:.5f} at the least"
            )
        if self.contact_time_s < 2.0 * self.time_step_s:
            raise ValueError(f"contact_time_s is {self.contact_time_s}; it must be at least two time steps")
