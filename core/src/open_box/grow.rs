//! From a proposal to a fitted box.

use super::evidence::{Evidence, Sheet};
use super::flap_scan::ScannedFlap;
use super::found_box::{FoundBox, COARSE_M, COARSE_STRIDE, FINE_M, ONCE_FITTED_M};
use super::hanging::{scan_flaps, with_flaps, FINE_SCAN};
use super::label::label;
use super::labels::{roles, Labels, Present};
use super::refit::refit;
use super::settle::is_sunk;
use super::sight::Sight;
use super::slots::likelihood_of_slots;
use super::sure::{drop_unsure, long_enough};
use crate::fit::{check, layout, FitSettings, FittedBody, NotFitted, Role, Solution};

/// Asked of a box that is fitted once whether it is worth a second fit.
pub type IsHopeful<'a> = &'a (dyn Fn(FoundBox) -> bool + Sync);

/// From a body with its scanned flaps to a box fitted to some of its readings, twice.
pub fn grow(
    sight: &Sight,
    body: &FittedBody,
    flaps: &[Option<ScannedFlap>; 4],
    settings: &FitSettings,
    is_hopeful: Option<IsHopeful>,
) -> Option<FoundBox> {
    let settings = competing(settings);
    let (body, present) = with_flaps(body, flaps);
    let labels = label(sight, &body, &present, COARSE_M, COARSE_STRIDE);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    sound(&solution.body).ok()?;
    if is_hopeful.is_some_and(|is_hopeful| !is_hopeful(weigh(sight, solution.clone(), present, COARSE_STRIDE))) {
        return None;
    }
    let (body, present) = with_flaps(&solution.body, &scan_flaps(sight, &solution.body, ONCE_FITTED_M, FINE_SCAN));
    let mut labels = label(sight, &body, &present, FINE_M, COARSE_STRIDE);
    drop_unsure(sight, &body, &mut labels);
    let solution = refit(sight, &body, &present, &labels, &settings).ok()?;
    sound(&solution.body).ok()?;
    Some(weigh(sight, solution, present, COARSE_STRIDE))
}

/// The body fitted to all of its readings as it stands; `None` where that leads to no box.
pub fn fitted_as_it_stands(
    sight: &Sight,
    body: &FittedBody,
    present: Present,
    settings: &FitSettings,
) -> Option<FoundBox> {
    let mut labels = label(sight, body, &present, FINE_M, 1);
    drop_unsure(sight, body, &mut labels);
    let solution = refit(sight, body, &present, &labels, settings).ok().filter(|one| sound(&one.body).is_ok())?;
    Some(weigh(sight, solution, present, 1))
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
