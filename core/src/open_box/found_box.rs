//! A fitted box that competes, and how well it is known.

use super::evidence::Evidence;
use super::feature_names::Features;
use super::judgement::Judgement;
use super::labels::{Labels, Present};
use crate::fit::{share_of_score, NotFitted, Role, SizeMatch, Solution};

/// An open box in the level frame.
#[derive(Debug, Clone)]
pub struct FoundBox {
    pub solution: Solution,
    pub present: Present,
    pub labels: Labels,
    pub evidence: Vec<(Role, Evidence)>,
    pub score: f64,
    /// That it is a box at all, while boxes compete; 1 where nobody judges.
    pub probability: f64,
    /// The given size that comes nearest; of a finished box, the one that it has.
    pub size: Option<SizeMatch>,
    /// Of flaps that stand up, what the corners between them say against higher sides, at most 1.
    pub slots: f64,
    /// Other fitted boxes that want its readings.
    pub rivals: usize,
    /// Why the fit to all of its readings did not end, where its body is that of fewer.
    pub of_fewer: Option<NotFitted>,
    pub features: Features,
    pub part_features: Vec<(Role, Features)>,
}

impl FoundBox {
    /// A fitted box that nobody has judged yet, without features.
    pub fn unjudged(
        solution: Solution,
        present: Present,
        labels: Labels,
        evidence: Vec<(Role, Evidence)>,
        score: f64,
    ) -> Self {
        Self {
            solution,
            present,
            labels,
            evidence,
            score,
            probability: 1.0,
            size: None,
            slots: 1.0,
            rivals: 0,
            of_fewer: None,
            features: Vec::new(),
            part_features: Vec::new(),
        }
    }

    /// What it holds, times the probability that it is a box, and one of a known size.
    pub fn rank(&self, probability: f64) -> f64 {
        self.score * share_of_score(self.size.as_ref()) * probability
    }

    /// The probability that a part's readings are that part's; `None` of a part without readings.
    pub fn part_probability(&self, role: Role, judgement: &Judgement) -> Option<f64> {
        let features = self.part_features.iter().find(|(r, _)| *r == role).map(|(_, features)| features);
        features.map(|features| judgement.part_probability(features))
    }

    /// Whether a part is told, if it has readings.
    pub fn is_probable(&self, role: Role, judgement: &Judgement) -> bool {
        self.part_probability(role, judgement).is_none_or(|p| p >= judgement.part_told_from())
    }
}

/// How well proposals, bodies fitted once and fitted bodies are known, beside the noise.
pub const COARSE_M: f64 = 0.007;
pub const ONCE_FITTED_M: f64 = 0.005;
pub const FINE_M: f64 = 0.004;

/// Every so many columns and rows are asked while boxes still compete.
pub const COARSE_STRIDE: usize = 3;
