//! What is expected of boxes before anything is seen: it keeps what was not seen where boxes usually have it (eq. 81).

use super::body::{edge_place, FittedBody, Parameters};
use super::layout::*;
use super::roles::Role;

/// `sum of factor * number` is `mean` give or take `sigma`.
#[derive(Debug, Clone, Copy)]
pub struct Prior {
    /// A number has no second one where the factor of that is 0.
    terms: [(usize, f64); 2],
    mean: f64,
    sigma: f64,
}

/// Mean and standard deviation of numbers, and what they come from.
/// Single-wall board: flutes E to C are 1.5 to 4 mm, glued boxboard 1 mm, double wall 6 to 7 mm.
const THICKNESS_M: (f64, f64) = (0.0035, 0.0015);
/// Boxes in use are a few degrees out of square.
const RACK_RAD: (f64, f64) = (0.0, 0.03);
/// Panels bend by millimetres, flaps by some degrees over their length.
const BULGE_M: (f64, f64) = (0.0, 0.003);
const CURL: (f64, f64) = (0.0, 0.5);
/// Flaps are slotted: a board and a little narrower than their side, in its middle.
const FLAP_LESS_THAN_SIDE_M: (f64, f64) = (-0.006, 0.01);
const OFFSET_M: (f64, f64) = (0.0, 0.004);
const TAPER_M: (f64, f64) = (0.0, 0.015);
const TUCK_LESS_THAN_FLAP_M: (f64, f64) = (-0.01, 0.03);
const LID_LESS_THAN_ACROSS_M: (f64, f64) = (-0.003, 0.003);
/// About the start, for sizes and angles: so weak that any reading outweighs it.
const SIZE_SIGMA_M: f64 = 0.2;
const ANGLE_SIGMA_RAD: f64 = 1.0;
/// How well a scan knows how far a surface reaches that goes on.
const KEPT_LENGTH_M: f64 = 0.02;

impl Prior {
    fn one(place: usize, (mean, sigma): (f64, f64)) -> Self {
        Self { terms: [(place, 1.0), (place, 0.0)], mean, sigma }
    }

    fn difference(place: usize, other: usize, (mean, sigma): (f64, f64)) -> Self {
        Self { terms: [(place, 1.0), (other, -1.0)], mean, sigma }
    }

    /// Its residual in standard deviations, and the derivatives of that.
    pub fn residual(&self, numbers: &Parameters) -> (f64, [(usize, f64); 2]) {
        let value: f64 = self.terms.iter().map(|&(place, factor)| factor * numbers[place]).sum();
        ((value - self.mean) / self.sigma, self.terms.map(|(place, factor)| (place, factor / self.sigma)))
    }
}

/// A flap or tuck flap beyond whose end its surface goes on, or which a tuck flap continues, has no end that the readings show:
/// it keeps the length of its start.
pub fn kept_length(start: &FittedBody, role: Role) -> Option<Prior> {
    let place = match role {
        Role::Flap(k) => flap(k) + FLAP_LENGTH,
        Role::Tuck(k) => tuck(k) + TUCK_LENGTH,
        Role::Base | Role::Side(_) => return None,
    };
    Some(Prior::one(place, (start.get(place), KEPT_LENGTH_M)))
}

/// A flap on which a tuck flap hangs reaches across the box: else that would tuck in nowhere.
pub fn lid_length(k: usize) -> Prior {
    Prior::difference(flap(k) + FLAP_LENGTH, edge_place(k + 1), LID_LESS_THAN_ACROSS_M)
}

/// How long flap `k` is where it is a lid, metres.
pub fn lid_length_m(body: &FittedBody, k: usize) -> f64 {
    body.get(edge_place(k + 1)) + LID_LESS_THAN_ACROSS_M.0
}

/// All priors of a box that starts as `start`.
pub fn priors(start: &FittedBody) -> Vec<Prior> {
    let size = |place: usize| Prior::one(place, (start.get(place), SIZE_SIGMA_M));
    let angle = |place: usize| Prior::one(place, (start.get(place), ANGLE_SIGMA_RAD));
    // The pose has none but what keeps the curvature from being singular.
    let mut out: Vec<Prior> = (0..POSE_COUNT).map(|place| Prior::one(place, (0.0, 1.0))).collect();
    out.extend([LENGTH, WIDTH, HEIGHT].map(size));
    out.push(Prior::one(RACK, RACK_RAD));
    out.push(Prior::one(THICKNESS, THICKNESS_M));
    for k in 0..4 {
        let (flap, tuck) = (flap(k), tuck(k));
        out.push(Prior::one(bulge(k), BULGE_M));
        out.extend([size(flap + FLAP_LENGTH), angle(flap + FLAP_ANGLE)]);
        out.push(Prior::difference(flap + FLAP_WIDTH, edge_place(k), FLAP_LESS_THAN_SIDE_M));
        out.push(Prior::one(flap + FLAP_TAPER, TAPER_M));
        out.push(Prior::one(flap + FLAP_OFFSET, OFFSET_M));
        out.push(Prior::one(flap + FLAP_CURL, CURL));
        out.extend([angle(tuck + TUCK_ANGLE), size(tuck + TUCK_LENGTH)]);
        out.push(Prior::difference(tuck + TUCK_WIDTH, flap + FLAP_WIDTH, TUCK_LESS_THAN_FLAP_M));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Isometry3;

    #[test]
    fn a_lid_reaches_across_its_box() {
        let mut body = FittedBody { input_from_object: Isometry3::identity(), numbers: Parameters::zeros() };
        (body.numbers[LENGTH], body.numbers[WIDTH]) = (0.4, 0.3);
        let mut cases = 0;
        for (k, across_m) in [0.3, 0.4, 0.3, 0.4].into_iter().enumerate() {
            let lid_m = lid_length_m(&body, k);
            assert!(lid_m < across_m && across_m - lid_m < 0.01, "{k}");
            body.numbers[flap(k) + FLAP_LENGTH] = lid_m;
            assert!(lid_length(k).residual(&body.numbers).0.abs() < 1e-9, "{k}");
            body.numbers[flap(k) + FLAP_LENGTH] += LID_LESS_THAN_ACROSS_M.1;
            assert!((lid_length(k).residual(&body.numbers).0 - 1.0).abs() < 1e-9, "{k}");
            cases += 1;
        }
        assert_eq!(cases, 4);
    }

    #[test]
    fn only_what_hangs_keeps_a_length_and_that_of_its_start() {
        let mut start = FittedBody { input_from_object: Isometry3::identity(), numbers: Parameters::zeros() };
        start.numbers[flap(2) + FLAP_LENGTH] = 0.15;
        start.numbers[tuck(2) + TUCK_LENGTH] = 0.04;
        for role in [Role::Base, Role::Side(2)] {
            assert!(kept_length(&start, role).is_none());
        }
        for role in [Role::Flap(2), Role::Tuck(2)] {
            let kept = kept_length(&start, role).unwrap();
            assert!(kept.residual(&start.numbers).0.abs() < 1e-12);
            assert!((kept.residual(&Parameters::zeros()).0 + start.get(kept.terms[0].0) / KEPT_LENGTH_M).abs() < 1e-12);
        }
    }
}
