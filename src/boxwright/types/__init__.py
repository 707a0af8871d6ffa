"""Frozen types, a leaf of the house: they hold and check values and know no algorithm."""

from boxwright.types.cloud import Cloud
from boxwright.types.truth import Camera, TrueBox, TruePart, Truth

__all__ = ["Camera", "Cloud", "TrueBox", "TruePart", "Truth"]
