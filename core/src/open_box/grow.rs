//! From a proposal to a fitted box.

use super::crease::with_creases;
use super::evidence::{Evidence, Sheet};
use super::features::{self, Features};
use super::flap_scan::ScannedFlap;
use super::hanging::{scan_flaps, scan_hidden_flaps, scan_tucks, with_flaps, with_tucks, FINE_SCAN};
use super::judgement::Judgement;
use super::label::label;
use super::labels::{roles, Labels, Present};
use super::owners::Owners;
use super::refit::refit;
use super::settle::is_sunk;
use super::shells::Shell;
use super::sight::Sight;
use super::start::body_of;
use super::sure::{drop_unsure, long_enough};
use crate::fit::{
    canonical_turn, check, layout, with_known_size, FitSettings, FittedBody, KnownSize, NotFitted, Role, SizeMatch,
    Solution,
};

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
    /// Why the fit to all of its readings did not end, where its body is that of fewer.
    pub of_fewer: Option<NotFitted>,
    pub features: Features,
    pub part_features: Vec<(Role, Features)>,
}

impl FoundBox {
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
const COARSE_STRIDE: usize = 3;

/// From a shell to a box fitted to some of its readings.
pub fn grow(sight: &Sight, shell: &Shell, settings: &FitSettings) -> Option<FoundBox> {
    let settings = competing(settings);
    let (body, present) = with_flaps(&body_of(&shell.proposal), &shell.flaps);
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

/// A box that has won, with its tuck flaps, fitted to all of its readings; it takes the one of `sizes` that it matches, if any.
///
/// # Errors
/// As of the fit, and where it ends in what is no box.
pub fn finish(
    sight: &Sight,
    owners: &Owners,
    found: FoundBox,
    sizes: &[KnownSize],
    settings: &FitSettings,
) -> Result<FoundBox, NotFitted> {
    let turn = canonical_turn(&found.solution.body, Some(sight.eye));
    let (body, present) = (found.solution.body.turned(turn), found.present.turned(turn));
    let (body, present) = with_tucks(&body, &present, &scan_tucks(sight, &body, &present, FINE_M));
    let mut labels = label(sight, &body, &present, FINE_M, 1);
    let (body, present) = match with_creases(sight, &body, &present, &labels) {
        Some((body, present)) => {
            labels = label(sight, &body, &present, FINE_M, 1);
            (body, present)
        }
        None => (body, present),
    };
    drop_unsure(sight, &body, &mut labels);
    let fit = |labels: &Labels, settings: &FitSettings| {
        refit(sight, &body, &present, labels, settings).and_then(sound_solution)
    };
    // Where all its readings lead to no body, fewer do, as they did before; that is told.
    let (solution, of_fewer) = match fit(&labels, settings) {
        Ok(solution) => (solution, None),
        Err(why) => {
            let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
            drop_unsure(sight, &body, &mut labels);
            (fit(&labels, &competing(settings))?, Some(why))
        }
    };
    let (solution, present) = look_again(sight, solution, present, settings);
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale.dimension);
    sound(&solution.body)?;
    let mut out = FoundBox { size, of_fewer, ..weigh(sight, solution, present, 1) };
    out.features = features::of_box(sight, owners, &out);
    let of = |(role, evidence): &(Role, Evidence)| {
        let points = out.labels.of(*role);
        (!points.is_empty()).then(|| (*role, features::of_part(sight, owners, &out, *role, points, evidence)))
    };
    out.part_features = out.evidence.iter().filter_map(of).collect();
    Ok(out)
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

fn sound_solution(solution: Solution) -> Result<Solution, NotFitted> {
    sound(&solution.body)?;
    Ok(solution)
}

/// A flap that was missed, or fitted where little lies, is taken from a scan of its edge where now more is met; one that is hidden
/// near its edge from one that looks further.
fn look_again(sight: &Sight, solution: Solution, present: Present, settings: &FitSettings) -> (Solution, Present) {
    let mut flaps = scan_flaps(sight, &solution.body, FINE_M, FINE_SCAN);
    let fitted_score = |k: usize| {
        let evidence = Sheet::new(&solution.body, Role::Flap(k), &sight.eye).look(sight, FINE_M);
        evidence.met - 2.0 * evidence.through
    };
    for (k, flap) in flaps.iter_mut().enumerate() {
        *flap = flap.filter(|flap| !present.flaps[k] || flap.score() > BETTER * fitted_score(k).max(0.0) + BETTER_PX);
    }
    let (solution, present) = taken_up(sight, solution, present, &flaps, settings);
    let hidden = scan_hidden_flaps(sight, &solution.body, FINE_M, present.flaps.map(|is_there| !is_there));
    taken_up(sight, solution, present, &hidden, settings)
}

/// Fitted with these flaps too, where more is held then.
fn taken_up(
    sight: &Sight,
    solution: Solution,
    present: Present,
    flaps: &[Option<ScannedFlap>; 4],
    settings: &FitSettings,
) -> (Solution, Present) {
    if flaps.iter().all(Option::is_none) {
        return (solution, present);
    }
    let (body, scanned) = with_flaps(&solution.body, flaps);
    let both = Present { flaps: std::array::from_fn(|k| present.flaps[k] || scanned.flaps[k]), ..present };
    let mut labels = label(sight, &body, &both, FINE_M, 1);
    drop_unsure(sight, &body, &mut labels);
    let again = refit(sight, &body, &both, &labels, settings).ok().filter(|again| sound(&again.body).is_ok());
    match again.map(|again| weigh(sight, again, both, 1)) {
        // A flap fitted to what is none costs more than it holds.
        Some(again) if again.score > weigh(sight, solution.clone(), present, 1).score => (again.solution, both),
        _ => (solution, present),
    }
}

/// A scan has this much more than the fit.
const BETTER: f64 = 1.25;
const BETTER_PX: f64 = 100.0;

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
    FoundBox {
        solution,
        present,
        labels,
        evidence,
        score,
        probability: 1.0,
        size: None,
        of_fewer: None,
        features: Vec::new(),
        part_features: Vec::new(),
    }
}
