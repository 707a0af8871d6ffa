"""boxwright: from one depth frame of an open box to its articulated 3D model."""

__version__ = "0.1.0"
