//! One body for what several views see of a box.

use nalgebra::Isometry3;

use super::super::found_box::{COARSE_M, FINE_M, ONCE_FITTED_M};
use super::super::grow::{competing, sound};
use super::super::label::label;
use super::super::labels::{Labels, Present};
use super::super::refit::refit_views;
use super::super::sight::Sight;
use super::super::sure::drop_unsure;
use super::flaps::{best_flaps, best_tucks};
use super::gather::Views;
use super::matching::Sighting;
use crate::fit::{canonical_turn, with_known_size, FitSettings, FittedBody, KnownSize, NotFitted, Solution};
use crate::open_box::FoundBox;

/// Every so many columns and rows are asked while starts still compete.
const COARSE_STRIDE: usize = 2;
/// Looks at the flaps of the body that won, at most.
const LOOKS: usize = 2;

/// The box that a group of sightings is of: the best of its joint fits from each of them.
///
/// # Errors
/// Where none ends in a box: why the last one does not.
pub fn fit_group(
    views: &Views,
    group: &[Sighting],
    sizes: &[KnownSize],
    settings: &FitSettings,
) -> Result<FoundBox, NotFitted> {
    let coarse = competing(settings);
    let mut best: Result<FoundBox, NotFitted> = Err(NotFitted::NoBox);
    for start in group {
        let finished = grow_jointly(views.sights, start, group, &coarse)
            .and_then(|(solution, present)| finish(views, solution, present, group, settings))
            .and_then(|(solution, present)| gathered(views, solution, present, sizes, settings));
        best = match (best, finished) {
            // Of bodies that explain the same readings the likelier one is told.
            (Ok(best), Ok(one)) if one.rank(one.probability) > best.rank(best.probability) => Ok(one),
            (Err(_), finished) => finished,
            (best, _) => best,
        };
    }
    best
}

/// It takes the size that it matches, if any.
fn gathered(
    views: &Views,
    solution: Solution,
    present: Present,
    sizes: &[KnownSize],
    settings: &FitSettings,
) -> Result<FoundBox, NotFitted> {
    let (solution, size) = with_known_size(solution, sizes, settings.seen_scale.dimension);
    sound(&solution.body)?;
    Ok(views.gather(&solution, present, size))
}

/// From one view's body to one that is fitted to some readings of all.
fn grow_jointly(
    sights: &[Sight],
    start: &Sighting,
    group: &[Sighting],
    settings: &FitSettings,
) -> Result<(Solution, Present), NotFitted> {
    let others = numbered_as(group, start.body());
    let (body, present) = best_flaps(sights, start.body(), &start.found.present, &others, COARSE_M);
    let solution = refit_labelled(sights, &body, &present, COARSE_M, COARSE_STRIDE, settings)?;
    let (body, present) = best_flaps(sights, &solution.body, &present, &others, ONCE_FITTED_M);
    let solution = refit_labelled(sights, &body, &present, FINE_M, COARSE_STRIDE, settings)?;
    Ok((solution, present))
}

/// With tuck flaps, fitted to all readings; what a last look at its flaps brings is kept where more is met then.
fn finish(
    views: &Views,
    solution: Solution,
    present: Present,
    group: &[Sighting],
    settings: &FitSettings,
) -> Result<(Solution, Present), NotFitted> {
    let sights = views.sights;
    let turn = canonical_turn(&solution.body, Some(sights[0].eye));
    let (body, present) = (solution.body.turned(turn), present.turned(turn));
    let others = numbered_as(group, &body);
    let (body, mut present) = best_tucks(sights, &body, &present, &others, FINE_M);
    let mut solution = refit_labelled(sights, &body, &present, FINE_M, 1, settings)?;
    for _ in 0..LOOKS {
        let (body, has) = best_flaps(sights, &solution.body, &present, &others, FINE_M);
        if body == solution.body && has == present {
            break;
        }
        let (body, has) = best_tucks(sights, &body, &has, &others, FINE_M);
        let Ok(again) = refit_labelled(sights, &body, &has, FINE_M, 1, settings) else { break };
        if views.score(&again, has, 1) <= views.score(&solution, present, 1) {
            break;
        }
        (solution, present) = (again, has);
    }
    Ok((solution, present))
}

/// Motions of the further views' readings, level frame, that suit a box best which several of them saw: their places as it tells them.
pub fn motions(sights: &[Sight], group: &[Sighting], settings: &FitSettings) -> Option<Vec<Isometry3<f64>>> {
    let settings = competing(settings);
    let start = &group[0];
    let others = numbered_as(group, start.body());
    let (body, present) = best_flaps(sights, start.body(), &start.found.present, &others, COARSE_M);
    let solution = refit_labelled(sights, &body, &present, COARSE_M, COARSE_STRIDE, &settings).ok()?;
    let at = solution.body.input_from_object;
    Some(solution.motions.iter().map(|motion| at * motion * at.inverse()).collect())
}

fn numbered_as(group: &[Sighting], body: &FittedBody) -> Vec<(FittedBody, Present)> {
    group.iter().map(|one| one.numbered_as(body)).collect()
}

/// Fitted to the readings of all views that lie on it (eq. 99).
///
/// # Errors
/// Where that does not end in a box.
fn refit_labelled(
    sights: &[Sight],
    body: &FittedBody,
    present: &Present,
    model_m: f64,
    stride: usize,
    settings: &FitSettings,
) -> Result<Solution, NotFitted> {
    let of_view = |sight: &Sight| {
        let mut labels = label(sight, body, present, model_m, stride);
        drop_unsure(sight, body, &mut labels);
        labels
    };
    let labels: Vec<Labels> = sights.iter().map(of_view).collect();
    let views: Vec<_> = sights.iter().zip(&labels).collect();
    let solution = refit_views(&views, body, present, settings)?;
    sound(&solution.body)?;
    Ok(solution)
}
