"""Frozen types, a leaf of the house: they hold and check values and know no algorithm."""

from boxwright.types.articulation import Joint, JointSigma, Parameter, Part, PartState, Pose
from boxwright.types.cloud import Cloud
from boxwright.types.intrinsics import Intrinsics
from boxwright.types.known_size import KnownSize, MatchedSize
from boxwright.types.model import FrameSource, Inference, Model, Object, ScoreTerm, Seconds, Source, SupportPlane
from boxwright.types.plan import FlapOutcome, FlapStatus, Plan, PlanSegment, SegmentKind, SmallestMove
from boxwright.types.posed import PosedCloud, PosedFile
from boxwright.types.robot import (
    BeyondUrdf,
    Gripper,
    Opw,
    Place,
    RobotBox,
    RobotCapsule,
    RobotFile,
    RobotJoint,
    RobotLink,
)
from boxwright.types.segments import Segment, Segmentation
from boxwright.types.simulation import FlapVerdict, Simulation, Stop
from boxwright.types.truth import Camera, TrueBox, TrueFace, TruePart, Truth

__all__ = [
    "BeyondUrdf",
    "Camera",
    "Cloud",
    "FlapOutcome",
    "FlapStatus",
    "FlapVerdict",
    "FrameSource",
    "Gripper",
    "Inference",
    "Intrinsics",
    "Joint",
    "JointSigma",
    "KnownSize",
    "MatchedSize",
    "Model",
    "Object",
    "Opw",
    "Parameter",
    "Part",
    "PartState",
    "Place",
    "Plan",
    "PlanSegment",
    "Pose",
    "PosedCloud",
    "PosedFile",
    "RobotBox",
    "RobotCapsule",
    "RobotFile",
    "RobotJoint",
    "RobotLink",
    "ScoreTerm",
    "Seconds",
    "Segment",
    "SegmentKind",
    "Segmentation",
    "Simulation",
    "SmallestMove",
    "Source",
    "Stop",
    "SupportPlane",
    "TrueBox",
    "TrueFace",
    "TruePart",
    "Truth",
]
