"""Frozen types, a leaf of the house: they hold and check values and know no algorithm."""

from boxwright.types.truth import Camera, Truth, TrueBox, TruePart

__all__ = ["Camera", "Truth", "TrueBox", "TruePart"]
