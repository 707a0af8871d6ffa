"""Learning of the weights from labelled frames."""

from boxwright.learning.judgement import LearnedJudgement, learn_judgement
from boxwright.learning.seen import SeenFrame
from boxwright.learning.train import train
from boxwright.learning.whole_method import calibrate

__all__ = ["LearnedJudgement", "SeenFrame", "calibrate", "learn_judgement", "train"]
