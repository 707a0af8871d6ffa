//! From an assignment of segments to parts to an articulated body: corners, hinges, angles (docs/maths.md, "Body").

mod answer;
mod belief;
mod box_frame;
mod box_panels;
mod build;
mod free;
mod hinge;
mod ring;

pub use answer::{
    InferenceAnswer, JointAnswer, JointSigma, ObjectAnswer, ParameterAnswer, PartAnswer, PoseAnswer, ScoreTermAnswer,
    SizeAnswer, Sums,
};
pub use build::build_object;
