"""Frozen types, a leaf of the house: they hold and check values and know no algorithm."""

from boxwright.types.articulation import Joint, JointSigma, Parameter, Part, PartState, Pose
from boxwright.types.cloud import Cloud
from boxwright.types.intrinsics import Intrinsics
from boxwright.types.known_size import KnownSize, MatchedSize
from boxwright.types.model import Inference, Model, Object, ScoreTerm, Seconds, Source, SupportPlane
from boxwright.types.segments import Segment, Segmentation
from boxwright.types.truth import Camera, TrueBox, TrueFace, TruePart, Truth

__all__ = [
    "Camera",
    "Cloud",
    "Inference",
    "Intrinsics",
    "Joint",
    "JointSigma",
    "KnownSize",
    "MatchedSize",
    "Model",
    "Object",
    "Parameter",
    "Part",
    "PartState",
    "Pose",
    "ScoreTerm",
    "Seconds",
    "Segment",
    "Segmentation",
    "Source",
    "SupportPlane",
    "TrueBox",
    "TrueFace",
    "TruePart",
    "Truth",
]
