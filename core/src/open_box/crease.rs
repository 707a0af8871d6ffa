//! A flap and the tuck flap on it that lie nearly in one plane are one board to a scan, which follows bends: a fold in the
//! section, or a flap longer than the box is across, tells them apart.

use nalgebra::{Matrix3, Vector3};

use super::hanging::TUCK_LESS_THAN_FLAP_M;
use super::labels::{Labels, Present};
use super::sight::Sight;
use crate::fit::{layout, FittedBody, Rim, Role};

/// Readings of a section, at most.
const SAMPLES: usize = 600;
/// Both boards are at least this long, and the tuck flap is at most this share of both.
const LEAST_M: f64 = 0.012;
const MOST_SHARE: f64 = 0.45;
const STEP_M: f64 = 0.0025;
/// Beyond the fold there are at least so many readings of a section.
const LEAST_BEYOND: usize = 20;
/// A fold turns by more than boards bend, and leaves this share of what a bent board leaves of squares.
const LEAST_TURN_RAD: f64 = 0.17;
const LEAST_LEFT: f64 = 0.8;
/// No flap is longer than the box is across by more.
const LONGER_M: f64 = 0.014;

/// Where a board folds, how its first piece and its second lie against the direction that it was given, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Fold {
    at_m: f64,
    first_rad: f64,
    second_rad: f64,
}

/// The body with the tuck flaps that were taken for the ends of their flaps; `None` where there are none.
pub fn with_creases(
    sight: &Sight,
    body: &FittedBody,
    present: &Present,
    labels: &Labels,
) -> Option<(FittedBody, Present)> {
    let (mut out, mut now) = (body.clone(), *present);
    for k in (0..4).filter(|&k| present.flaps[k] && !present.tucks[k]) {
        let length_m = body.get(layout::flap(k) + layout::FLAP_LENGTH);
        let section = section(sight, body, k, labels.of(Role::Flap(k)));
        let across_m = body.edge_m(k + 1);
        let longer = || (length_m > across_m + LONGER_M).then(|| fold_at(&section, across_m)).flatten();
        let Some(fold) = fold(&section, length_m).or_else(longer) else { continue };
        now.tucks[k] = true;
        out.numbers[layout::flap(k) + layout::FLAP_LENGTH] = fold.at_m;
        out.numbers[layout::flap(k) + layout::FLAP_ANGLE] += fold.first_rad;
        out.numbers[layout::flap(k) + layout::FLAP_CURL] = 0.0;
        out.numbers[layout::tuck(k) + layout::TUCK_LENGTH] = length_m - fold.at_m;
        out.numbers[layout::tuck(k) + layout::TUCK_WIDTH] =
            body.get(layout::flap(k) + layout::FLAP_WIDTH) - TUCK_LESS_THAN_FLAP_M;
        // A tuck flap's position grows against its flap's.
        out.numbers[layout::tuck(k) + layout::TUCK_ANGLE] = fold.first_rad - fold.second_rad;
    }
    (now != *present).then_some((out, now))
}

/// Readings of a flap by their way from the hinge along its direction there, and their height over that, m.
fn section(sight: &Sight, body: &FittedBody, k: usize, points: &[u32]) -> Vec<[f64; 2]> {
    let rim = Rim::new(body, k);
    let (sin, cos) = body.get(layout::flap(k) + layout::FLAP_ANGLE).sin_cos();
    let step = points.len().div_ceil(SAMPLES).max(1);
    let place = |index: &u32| {
        let at = rim.locate(body.to_object(&sight.reading(*index as usize)?));
        Some([cos * at.inward + sin * at.above, cos * at.above - sin * at.inward])
    };
    points.iter().step_by(step).filter_map(place).collect()
}

/// The best fold of a section, where it is one rather than a bend.
fn fold(section: &[[f64; 2]], length_m: f64) -> Option<Fold> {
    let (bent, _) = least_squares(section, |x| x * x)?;
    let from = LEAST_M.max((1.0 - MOST_SHARE) * length_m);
    let steps = ((length_m - LEAST_M - from) / STEP_M).floor().max(-1.0) as isize;
    let places = (0..=steps).map(|i| from + i as f64 * STEP_M);
    let folds = places.filter(|&at_m| section.iter().filter(|p| p[0] > at_m).count() >= LEAST_BEYOND);
    let tried = folds.filter_map(|at_m| Some((at_m, least_squares(section, |x| (x - at_m).max(0.0))?)));
    let (at_m, (left, line)) = tried.reduce(|best, one| if one.1 .0 < best.1 .0 { one } else { best })?;
    let fold = folded(at_m, &line);
    ((fold.second_rad - fold.first_rad).abs() > LEAST_TURN_RAD && left < LEAST_LEFT * bent).then_some(fold)
}

fn fold_at(section: &[[f64; 2]], at_m: f64) -> Option<Fold> {
    let (_, line) = least_squares(section, |x| (x - at_m).max(0.0))?;
    Some(folded(at_m, &line))
}

fn folded(at_m: f64, line: &Vector3<f64>) -> Fold {
    Fold { at_m, first_rad: line.y.atan(), second_rad: (line.y + line.z).atan() }
}

/// What `a + b x + c further(x)` leaves of the squares of a section's heights, and a, b, c.
fn least_squares(section: &[[f64; 2]], further: impl Fn(f64) -> f64) -> Option<(f64, Vector3<f64>)> {
    let row = |x: f64| Vector3::new(1.0, x, further(x));
    let mut normal_equations = Matrix3::identity() * 1e-9;
    let mut right = Vector3::zeros();
    for [x, y] in section {
        normal_equations += row(*x) * row(*x).transpose();
        right += row(*x) * *y;
    }
    let line = normal_equations.cholesky()?.solve(&right);
    Some((section.iter().map(|[x, y]| (y - line.dot(&row(*x))).powi(2)).sum(), line))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every millimetre of a board of 0.3 m, with a ripple of 2 mm.
    fn board(height: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..300).map(|i| f64::from(i) * 1e-3).map(|x| [x, height(x) + 0.002 * (x * 2e3).sin()]).collect()
    }

    #[test]
    fn folds_are_found_where_they_are() {
        let mut cases = 0;
        for turn_deg in [-40.0_f64, -20.0, 15.0, 30.0] {
            for at_m in [0.22, 0.25, 0.27] {
                let turn = turn_deg.to_radians();
                let folded = board(|x| 0.05 * x + (x - at_m).max(0.0) * ((0.05_f64.atan() + turn).tan() - 0.05));
                let fold = fold(&folded, 0.3).unwrap();
                assert!((fold.at_m - at_m).abs() < 0.01, "{turn_deg} {at_m}: {fold:?}");
                assert!((fold.second_rad - fold.first_rad - turn).abs() < 0.1, "{turn_deg} {at_m}: {fold:?}");
                cases += 1;
            }
        }
        assert_eq!(cases, 12);
    }

    #[test]
    fn flat_and_bent_boards_have_none() {
        assert_eq!(fold(&board(|x| 0.1 * x), 0.3), None);
        assert_eq!(fold(&board(|x| 0.8 * x * x), 0.3), None);
        assert_eq!(fold(&[], 0.3), None);
        assert_eq!(fold(&board(|_| 0.0), 0.01), None);
    }
}
