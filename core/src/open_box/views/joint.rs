//! One body for what several views see of a box.

use nalgebra::Isometry3;

use super::super::grow::{sound, COARSE_M, FINE_M, ONCE_FITTED_M};
use super::super::refit::refit_views;
use super::super::sight::Sight;
use super::super::sure::drop_unsure;
use super::super::surfaces::{label, Labels, Present};
use super::flaps::{best_flaps, best_tucks};
use super::gather::Views;
use super::matching::Sighting;
use crate::fit::{canonical_turn, with_known_size, FitSettings, FittedBody, KnownSize, Solution};
use crate::open_box::FoundBox;

/// Every so many columns and rows are asked while starts still compete.
const COARSE_STRIDE: usize = 2;
/// Looks at the flaps of the body that won, at most.
const LOOKS: usize = 2;

/// The box that a group of sightings is of, the best of its joint fits from each of them; where none ends, its best sighting as it
/// was, and a line that says so.
pub fn fit_group(
    views: &Views,
    group: &[Sighting],
    sizes: &[KnownSize],
    settings: &FitSettings,
    warnings: &mut Vec<String>,
) -> FoundBox {
    let coarse = coarse(settings);
    let mut best: Option<(f64, Solution, Present)> = None;
    for start in group {
        let Some((solution, present)) = grow_jointly(views.sights, start, group, &coarse) else { continue };
        let score = views.score(&solution, present, COARSE_STRIDE);
        if best.as_ref().is_none_or(|(most, ..)| score > *most) {
            best = Some((score, solution, present));
        }
    }
    let finished = best.and_then(|(_, solution, present)| finish(views, solution, present, group, settings));
    let (solution, present) = finished.unwrap_or_else(|| {
        warnings.push(format!("no body fitted to all frames converged; that of frame {} is told", group[0].view + 1));
        let turn = canonical_turn(group[0].body(), Some(views.sights[0].eye));
        let covariance = group[0].found.solution.covariance.clone();
        (Solution { body: group[0].body().turned(turn), covariance }, group[0].found.present.turned(turn))
    });
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale);
    views.gather(&solution, present, size)
}

/// From one view's body to one that is fitted to some readings of all.
fn grow_jointly(
    sights: &[Sight],
    start: &Sighting,
    group: &[Sighting],
    settings: &FitSettings,
) -> Option<(Solution, Present)> {
    let others = numbered_as(group, start.body());
    let (body, present) = best_flaps(sights, start.body(), &start.found.present, &others, COARSE_M);
    let (solution, _) = refit_labelled(sights, &body, &present, COARSE_M, COARSE_STRIDE, settings)?;
    let (body, present) = best_flaps(sights, &solution.body, &present, &others, ONCE_FITTED_M);
    let (solution, _) = refit_labelled(sights, &body, &present, FINE_M, COARSE_STRIDE, settings)?;
    Some((solution, present))
}

/// With tuck flaps, fitted to all readings; what a last look at its flaps brings is kept where more is met then.
fn finish(
    views: &Views,
    solution: Solution,
    present: Present,
    group: &[Sighting],
    settings: &FitSettings,
) -> Option<(Solution, Present)> {
    let sights = views.sights;
    let turn = canonical_turn(&solution.body, Some(sights[0].eye));
    let (body, present) = (solution.body.turned(turn), present.turned(turn));
    let others = numbered_as(group, &body);
    let (body, mut present) = best_tucks(sights, &body, &present, &others, FINE_M);
    let (mut solution, _) = refit_labelled(sights, &body, &present, FINE_M, 1, settings)?;
    for _ in 0..LOOKS {
        let (body, has) = best_flaps(sights, &solution.body, &present, &others, FINE_M);
        if body == solution.body && has == present {
            break;
        }
        let (body, has) = best_tucks(sights, &body, &has, &others, FINE_M);
        let Some((again, _)) = refit_labelled(sights, &body, &has, FINE_M, 1, settings) else { break };
        if views.score(&again, has, 1) <= views.score(&solution, present, 1) {
            break;
        }
        (solution, present) = (again, has);
    }
    Some((solution, present))
}

/// Motions of the further views' readings, level frame, that suit a box best which several of them saw: their places as it tells them.
pub fn motions(sights: &[Sight], group: &[Sighting], settings: &FitSettings) -> Option<Vec<Isometry3<f64>>> {
    let settings = coarse(settings);
    let start = &group[0];
    let others = numbered_as(group, start.body());
    let (body, present) = best_flaps(sights, start.body(), &start.found.present, &others, COARSE_M);
    let (_, motions) = refit_labelled(sights, &body, &present, COARSE_M, COARSE_STRIDE, &settings)?;
    Some(motions)
}

/// While boxes and places are not yet known well.
fn coarse(settings: &FitSettings) -> FitSettings {
    FitSettings { face_samples: 40, end_strips: 10, least_gain: 1e-2, ..*settings }
}

fn numbered_as(group: &[Sighting], body: &FittedBody) -> Vec<(FittedBody, Present)> {
    group.iter().map(|one| one.numbered_as(body)).collect()
}

/// Fitted to the readings of all views that lie on it (eq. 99); `None` where that does not end in a box.
fn refit_labelled(
    sights: &[Sight],
    body: &FittedBody,
    present: &Present,
    model_m: f64,
    stride: usize,
    settings: &FitSettings,
) -> Option<(Solution, Vec<Isometry3<f64>>)> {
    let of_view = |sight: &Sight| {
        let mut labels = label(sight, body, present, model_m, stride);
        drop_unsure(sight, body, &mut labels);
        labels
    };
    let labels: Vec<Labels> = sights.iter().map(of_view).collect();
    let views: Vec<_> = sights.iter().zip(&labels).collect();
    let (solution, motions) = refit_views(&views, body, present, settings).ok()?;
    sound(&solution.body)?;
    Some((solution, motions))
}
