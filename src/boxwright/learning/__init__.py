"""Learning of the weights from labelled frames."""

from boxwright.learning.seen import SeenFrame
from boxwright.learning.train import train

__all__ = ["SeenFrame", "train"]
