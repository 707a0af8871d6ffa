//! From a proposal to a fitted box.

use super::evidence::{Evidence, Sheet};
use super::features::{self, Features};
use super::hanging::{scan_flaps, scan_tucks, with_flaps, with_tucks, FINE_SCAN};
use super::refit::refit;
use super::shells::Shell;
use super::sight::Sight;
use super::start::body_of;
use super::sure::{drop_unsure, long_enough};
use super::surfaces::{label, roles, Labels, Present};
use crate::fit::{
    canonical_turn, check, layout, with_known_size, FitSettings, FittedBody, KnownSize, Role, SizeMatch, Solution,
};

/// An open box in the level frame.
#[derive(Debug, Clone)]
pub struct FoundBox {
    pub solution: Solution,
    pub present: Present,
    pub labels: Labels,
    pub evidence: Vec<(Role, Evidence)>,
    pub score: f64,
    /// The given size that comes nearest; of a finished box, the one that it has.
    pub size: Option<SizeMatch>,
    pub features: Features,
    pub part_features: Vec<(Role, Features)>,
}

/// How well proposals, bodies fitted once and fitted bodies are known, beside the noise.
pub const COARSE_M: f64 = 0.007;
const ONCE_FITTED_M: f64 = 0.005;
pub const FINE_M: f64 = 0.004;

/// Every so many columns and rows are asked while boxes still compete.
const COARSE_STRIDE: usize = 3;

/// From a shell to a box fitted to some of its readings.
pub fn grow(sight: &Sight, shell: &Shell, settings: &FitSettings) -> Option<FoundBox> {
    let settings = FitSettings { face_samples: 40, end_strips: 10, least_gain: 1e-2, ..*settings };
    let (body, present) = with_flaps(&body_of(&shell.proposal), &shell.flaps);
    let labels = label(sight, &body, &present, COARSE_M, COARSE_STRIDE);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    check(&solution.body).ok()?;
    let (body, present) = with_flaps(&solution.body, &scan_flaps(sight, &solution.body, ONCE_FITTED_M, FINE_SCAN));
    let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    check(&solution.body).ok()?;
    Some(weigh(sight, solution, present, COARSE_STRIDE))
}

/// A box that has won, with its tuck flaps, fitted to all of its readings; it takes the one of `sizes` that it matches, if any.
pub fn finish(sight: &Sight, found: FoundBox, sizes: &[KnownSize], settings: &FitSettings) -> Option<FoundBox> {
    let turn = canonical_turn(&found.solution.body, Some(sight.eye));
    let (body, present) = (found.solution.body.turned(turn), found.present.turned(turn));
    let (body, present) = with_tucks(&body, &present, &scan_tucks(sight, &body, &present, FINE_M));
    let mut labels = label(sight, &body, &present, FINE_M, 1);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, settings).ok()?;
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale);
    check(&solution.body).ok()?;
    let mut out = FoundBox { size, ..weigh(sight, solution, present, 1) };
    out.features = features::of_box(sight, &out);
    let of = |(role, evidence): &(Role, Evidence)| {
        let points = out.labels.of(*role);
        (!points.is_empty()).then(|| (*role, features::of_part(sight, &out.solution.body, *role, points, evidence)))
    };
    out.part_features = out.evidence.iter().filter_map(of).collect();
    Some(out)
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
fn weigh(sight: &Sight, solution: Solution, present: Present, stride: usize) -> FoundBox {
    let present = long_enough(&solution.body, &present);
    let mut labels = label(sight, &solution.body, &present, FINE_M, stride);
    drop_unsure(sight, &solution.body, &mut labels);
    let look = |role: Role| (role, Sheet::new(&solution.body, role, &sight.eye).look(sight, FINE_M));
    let evidence: Vec<(Role, Evidence)> = roles(&present).into_iter().map(look).collect();
    let score = score(sight, &solution.body, &labels, &evidence);
    FoundBox { solution, present, labels, evidence, score, size: None, features: Vec::new(), part_features: Vec::new() }
}
