//! An object as `model.json` writes it (docs/formats.md); metres, radians, the input's frame.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::free_space::PartState;
use crate::geometry::Vec3;
use crate::model::Calibration;

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObjectAnswer {
    pub template: String,
    pub template_probability: Option<f64>,
    pub score: f64,
    pub probability: Option<f64>,
    pub inference: InferenceAnswer,
    /// What the score is made of, features first, in the template's order.
    pub score_terms: Vec<ScoreTermAnswer>,
    pub dimensions: Option<[f64; 3]>,
    pub outer_dimensions: Option<[f64; 3]>,
    pub thickness: Option<f64>,
    /// The given size that it matches.
    pub size: Option<SizeAnswer>,
    pub pose: Option<PoseAnswer>,
    pub parameters: BTreeMap<String, ParameterAnswer>,
    pub parts: Vec<PartAnswer>,
    pub joints: Vec<JointAnswer>,
    /// Where all assignments were summed; what the parts' probabilities are made of.
    #[serde(skip)]
    pub sums: Option<Sums>,
}

/// What sums over all assignments say of an object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sums {
    /// Of the whole assignment.
    pub assignment: f64,
    /// The share of the probability that the sums left out, at most (eq. 51).
    pub unsummed: f64,
    pub calibration: Calibration,
}

/// A given size, its outer lengths along the object's length, width and height.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SizeAnswer {
    pub name: String,
    pub outer_dimensions: [f64; 3],
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterAnswer {
    pub value: f64,
    pub sigma: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InferenceAnswer {
    pub status: &'static str,
    pub gap: Option<f64>,
    pub alternatives: usize,
    /// The share of the probability that the sums left out, at most.
    pub unsummed: Option<f64>,
}

/// One feature or relation, summed over its parts; `contribution` = weight x value is its share of the score.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ScoreTermAnswer {
    pub name: String,
    /// The paper's name of its kind.
    pub kind: &'static str,
    pub value: f64,
    pub weight: f64,
    pub contribution: f64,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PoseAnswer {
    pub position: [f64; 3],
    /// x, y, z, w.
    pub orientation: [f64; 4],
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartAnswer {
    pub name: String,
    pub observed: bool,
    pub state: Option<PartState>,
    /// Of a hidden part: unit vector from it towards a place that sees it.
    pub seen_from: Option<[f64; 3]>,
    pub probability: Option<f64>,
    /// Of the segment in this part, by the sums.
    #[serde(skip)]
    pub marginal: Option<f64>,
    pub corners: Option<[[f64; 3]; 4]>,
    pub points: usize,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointAnswer {
    pub name: String,
    #[serde(rename = "type")]
    pub kind: &'static str,
    pub parent: String,
    pub child: String,
    pub origin: [f64; 3],
    pub axis: [f64; 3],
    pub position: f64,
    pub limits: [f64; 2],
    /// Told where a body was fitted.
    pub sigma: Option<JointSigma>,
}

/// Standard deviations of a hinge: position rad, origin m, axis rad.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointSigma {
    pub position: f64,
    pub origin: [f64; 3],
    pub axis: f64,
}

impl InferenceAnswer {
    /// `gap`: how much a better assignment could add at most; infinite where nobody knows.
    pub fn new(gap: f64, alternatives: usize, unsummed: Option<f64>) -> Self {
        let status = if gap == 0.0 { "optimal" } else { "gap" };
        Self { status, gap: gap.is_finite().then_some(gap), alternatives, unsummed }
    }
}

impl PartAnswer {
    /// A part that nobody saw and nothing tells of.
    pub fn unseen(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            observed: false,
            state: None,
            probability: None,
            corners: None,
            points: 0,
            marginal: None,
            seen_from: None,
        }
    }
}

pub fn array(v: &Vec3) -> [f64; 3] {
    [v.x, v.y, v.z]
}

pub fn corner_arrays(corners: &[Vec3; 4]) -> [[f64; 3]; 4] {
    corners.map(|c| array(&c))
}
