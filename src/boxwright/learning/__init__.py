"""Learning of the weights from labelled frames."""

from boxwright.learning.train import SeenFrame, train

__all__ = ["SeenFrame", "train"]
