//! From a proposal to a fitted box.

use super::evidence::{Evidence, Sheet};
use super::features::Features;
use super::flap_scan::ScannedFlap;
use super::hanging::{scan_flaps, with_flaps, FINE_SCAN};
use super::judgement::Judgement;
use super::label::label;
use super::labels::{roles, Labels, Present};
use super::refit::refit;
use super::settle::is_sunk;
use super::sight::Sight;
use super::slots::likelihood_of_slots;
use super::sure::{drop_unsure, long_enough};
use crate::fit::{check, layout, share_of_score, FitSettings, FittedBody, NotFitted, Role, SizeMatch, Solution};

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

/// From a body with its scanned flaps to a box fitted to some of its readings.
pub fn grow(
    sight: &Sight,
    body: &FittedBody,
    flaps: &[Option<ScannedFlap>; 4],
    settings: &FitSettings,
) -> Option<FoundBox> {
    let settings = competing(settings);
    let (body, present) = with_flaps(body, flaps);
    let labels = label(sight, &body, &present, COARSE_M, COARSE_STRIDE);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    sound(&solution.body).ok()?;
    let (body, present) = with_flaps(&solution.body, &scan_flaps(sight, &solution.body, ONCE_FITTED_M, FINE_SCAN));
    let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    sound(&solution.body).ok()?;
    Some(weigh(sight, solution, present, COARSE_STRIDE))
}

/// Of boxes that still compete, and of places that are not yet known well.
pub fn competing(settings: &FitSettings) -> FitSettings {
    FitSettings { face_samples: 40, end_strips: 10, least_gain: 1e-2, ..*settings }
}

/// Refuses a body that no box has.
pub fn sound(body: &FittedBody) -> Result<(), NotFitted> {
    check(body)?;
    if is_sunk(body) {
        return Err(NotFitted::Sunk);
    }
    Ok(())
}

/// Readings on its panels, each counted once, less twice those through them, less those that close the opening and are of no
/// flap. The base says nothing: the floor agrees as well.
fn score(sight: &Sight, body: &FittedBody, labels: &Labels, evidence: &[(Role, Evidence)]) -> f64 {
    let lid = Sheet::of_opening(body, &sight.eye).look(sight, FINE_M).met;
    let is_closed =
        |role: Role| matches!(role, Role::Flap(k) if body.get(layout::flap(k) + layout::FLAP_ANGLE).abs() < CLOSED_RAD);
    let on = |wanted: &dyn Fn(Role) -> bool| -> f64 {
        labels.parts.iter().filter(|(role, _)| wanted(*role)).map(|(_, points)| labels.count(points) as f64).sum()
    };
    let through: f64 = evidence.iter().map(|(_, e)| e.through).sum();
    on(&|role| role != Role::Base) - 2.0 * through - (lid - on(&is_closed)).max(0.0)
}

const CLOSED_RAD: f64 = 0.3;

/// A fitted box with its readings and what the rays say of its panels.
pub fn weigh(sight: &Sight, solution: Solution, present: Present, stride: usize) -> FoundBox {
    let present = long_enough(&solution.body, &present);
    let mut labels = label(sight, &solution.body, &present, FINE_M, stride);
    drop_unsure(sight, &solution.body, &mut labels);
    let look = |role: Role| (role, Sheet::new(&solution.body, role, &sight.eye).look(sight, FINE_M));
    let evidence: Vec<(Role, Evidence)> = roles(&present).into_iter().map(look).collect();
    let score = score(sight, &solution.body, &labels, &evidence);
    let slots = likelihood_of_slots(sight, &solution.body, &present);
    FoundBox { slots, ..FoundBox::unjudged(solution, present, labels, evidence, score) }
}
