//! Flaps that stand up continue their sides: nothing but the slots between them, open at the corners, tells where the sides end.

use super::found_box::FINE_M;
use super::labels::Present;
use super::sight::{Says, Sight};
use crate::fit::{layout, FittedBody, Rim};
use crate::geometry::Vec3;

/// A corner is asked at each pixel up its edge; neighbouring pixels say the same, this share of what they would say each.
const APART: f64 = 1.0 / 3.0;
/// The shares of their pixels at which corners of sides are looked through, and how many of them: hardly, but for those that stand
/// before what lies behind.
const THROUGH_CORNERS: [(f64, f64); 5] = [(0.01, 0.45), (0.05, 0.25), (0.2, 0.1), (0.5, 0.1), (0.95, 0.1)];
/// The same of slots; of some nothing is seen.
const THROUGH_SLOTS: [(f64, f64); 4] = [(0.05, 0.25), (0.4, 0.25), (0.7, 0.25), (0.95, 0.25)];
/// A corner of which less is seen below a height says nothing of it, pixels.
const LEAST_BELOW: f64 = 8.0;
/// Left out at the top, where edges are ragged, and at the foot, metres.
const TOP_M: f64 = 0.008;
const FOOT_M: f64 = 0.015;
/// Neither sides nor flaps are shorter, metres.
const LEAST_M: f64 = 0.03;
const STEP_M: f64 = 0.003;
/// The sensor sees nothing of a slot's end: it opens so many pixels above.
const CLOSED_PX: f64 = 3.0;
/// The logarithm of the odds from which slots are told.
const LEAST_ODDS: f64 = 5.0;

/// The height of the sides of a body whose corners are open above it, m, where that is told (eq. 104).
pub fn height_by_slots(sight: &Sight, body: &FittedBody) -> Option<f64> {
    let corners: Vec<Vec<(f64, bool)>> = (0..4).map(|k| corner(sight, body, k)).collect();
    let top = body.get(layout::HEIGHT);
    let steps = ((top - 2.0 * LEAST_M) / STEP_M).floor().max(-1.0) as isize;
    let heights = (0..=steps).map(|i| LEAST_M + i as f64 * STEP_M);
    let told = heights.map(|height| (odds(&corners, height), height));
    let best = told.reduce(|best, one| if one.0 > best.0 { one } else { best })?;
    let range_m = (body.to_input(&Vec3::new(0.0, 0.0, best.1)) - sight.eye).norm();
    (best.0 >= LEAST_ODDS).then(|| (best.1 - CLOSED_PX * sight.pixel_rad * range_m).max(LEAST_M))
}

/// A flap within so much of upright may as well be the top of its side.
const STANDING_RAD: f64 = 0.1;

/// How much likelier what is seen of the corners between flaps that stand up is with slots in them than if the sides went on, at
/// most 1 (eq. 104): 1 where no two neighbours stand.
pub fn likelihood_of_slots(sight: &Sight, body: &FittedBody, present: &Present) -> f64 {
    let flap = |k: usize, number: usize| body.get(layout::flap(k % 4) + number);
    let stands = |k: usize| {
        let upright = (flap(k, layout::FLAP_ANGLE) - std::f64::consts::FRAC_PI_2).abs() < STANDING_RAD;
        present.flaps[k % 4] && upright && flap(k, layout::FLAP_LENGTH) > LEAST_M
    };
    let of_corner = |k: usize| {
        let mut higher = body.clone();
        higher.numbers[layout::HEIGHT] += flap(k, layout::FLAP_LENGTH).min(flap(k + 1, layout::FLAP_LENGTH));
        odds_of_corner(&corner(sight, &higher, k), body.get(layout::HEIGHT))
    };
    let log_odds: f64 = (0..4).filter(|&k| stands(k) && stands(k + 1)).map(of_corner).sum();
    log_odds.exp().min(1.0)
}

/// Up the edge between sides `k` and `k + 1`: heights at which something is seen there, and whether it lies behind the edge.
fn corner(sight: &Sight, body: &FittedBody, k: usize) -> Vec<(f64, bool)> {
    let (rim, half, top) = (Rim::new(body, k), body.edge_m(k) / 2.0, body.get(layout::HEIGHT));
    let at = |height: f64| body.to_input(&rim.place(half, 0.0, height - top));
    let pixel_m = sight.pixel_rad * (at(top / 2.0) - sight.eye).norm();
    let count = ((top - TOP_M - FOOT_M) / pixel_m).floor().max(0.0) as usize;
    let asked = (0..count).map(|i| FOOT_M + i as f64 * pixel_m);
    let seen = asked.filter_map(|height| {
        let point = at(height);
        match sight.ask(&point, &(point - sight.eye).normalize(), FINE_M).0 {
            Says::Met => Some((height, false)),
            Says::Through => Some((height, true)),
            _ => None,
        }
    });
    seen.collect()
}

/// The logarithm of the odds of slots above a height against corners that go on to the top.
fn odds(corners: &[Vec<(f64, bool)>], height: f64) -> f64 {
    corners.iter().map(|corner| odds_of_corner(corner, height)).sum()
}

/// A corner is looked through at one share of its pixels all the way up, or at another above the height.
fn odds_of_corner(corner: &[(f64, bool)], height: f64) -> f64 {
    let count = |is_above: bool| {
        let there = corner.iter().filter(|(at, _)| (*at >= height) == is_above);
        there
            .fold([0.0, 0.0], |[met, through], (_, t)| if *t { [met, through + APART] } else { [met + APART, through] })
    };
    let (below, above) = (count(false), count(true));
    if below[0] + below[1] < LEAST_BELOW * APART {
        return 0.0;
    }
    let likelihood = |counts: [f64; 2], share: f64| share.powf(counts[1]) * (1.0 - share).powf(counts[0]);
    let of_slots: f64 = THROUGH_SLOTS.iter().map(|(share, of)| of * likelihood(above, *share)).sum();
    let of_corners = |is_slot: bool| -> f64 {
        let of = |(share, of): &(f64, f64)| {
            of * likelihood(below, *share) * if is_slot { of_slots } else { likelihood(above, *share) }
        };
        THROUGH_CORNERS.iter().map(of).sum()
    };
    (of_corners(true) / of_corners(false)).ln()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pixels two millimetres apart up a corner; `o` is looked through.
    fn seen(corner: &str) -> Vec<(f64, bool)> {
        corner.chars().enumerate().map(|(i, c)| (i as f64 * 0.002, c == 'o')).collect()
    }

    /// A corner of so many pixels, looked through in each of `of` pixels but the first `closed` from a height on, and in none before.
    fn corner(below: usize, above: usize, of: usize, closed: usize) -> Vec<(f64, bool)> {
        let slot = (0..above).map(|i| if i % of < closed { '#' } else { 'o' });
        seen(&std::iter::repeat_n('#', below).chain(slot).collect::<String>())
    }

    #[test]
    fn corners_that_open_tell_the_height_at_which_they_do() {
        let mut cases = 0;
        for below in [40, 70, 100] {
            for (of, closed) in [(1, 0), (4, 1), (3, 1)] {
                let corners = [corner(below, 60, of, closed), corner(below, 60, 1, 1), corner(3, 0, 1, 0)];
                let best = (1..150).map(|i| f64::from(i) * 0.002).map(|height| (odds(&corners, height), height));
                let best = best.reduce(|best, one| if one.0 > best.0 { one } else { best }).unwrap();
                assert!(best.0 > LEAST_ODDS, "{below} {of}: {best:?}");
                assert!((best.1 - below as f64 * 0.002).abs() < 0.007, "{below} {of}: {best:?}");
                cases += 1;
            }
        }
        assert_eq!(cases, 9);
    }

    #[test]
    fn corners_that_are_alike_all_the_way_tell_nothing() {
        let ragged = "#o##o".repeat(24);
        let mut cases = 0;
        for same in ["#".repeat(120), "o".repeat(120), ragged, format!("{}ooo", "#".repeat(117))] {
            let corners = vec![seen(&same); 4];
            // Flaps are no shorter than 30 mm.
            for i in 1..105 {
                let height = f64::from(i) * 0.002;
                assert!(odds(&corners, height) < LEAST_ODDS, "{same} {height}");
                cases += 1;
            }
        }
        assert_eq!(cases, 416);
    }
}
