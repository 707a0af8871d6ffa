"""Learning of the weights from labelled frames."""

from boxwright.learning.judgement import LearnedJudgement, learn_judgement
from boxwright.learning.seen import SeenFrame
from boxwright.learning.train import train

__all__ = ["LearnedJudgement", "SeenFrame", "learn_judgement", "train"]
