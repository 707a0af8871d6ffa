//! What an open box shows that a closed one does not: its inside, that of its flaps too, or a flap out of the plane of its side.

use std::f64::consts::FRAC_PI_2;

use super::feature_names::named;
use super::features::amount;
use super::found_box::FoundBox;
use crate::fit::{layout, Role};

/// A flap this near to its side's plane continues it, rad: about 12 degrees.
const IN_PLANE_RAD: f64 = 0.21;
/// So many readings on inner faces, on the base or through the opening are its inside.
const LEAST_INSIDE: f64 = 100.0;

/// Whether all that was seen of it could be the outside of a closed box: the front of a carton that stands is a side and a flap
/// in its plane, its top a tuck flap on that.
pub fn may_be_closed(found: &FoundBox) -> bool {
    let inner: f64 =
        found.evidence.iter().filter(|(_, evidence)| evidence.is_inner).map(|(_, evidence)| evidence.met).sum();
    let base = found.labels.count(found.labels.of(Role::Base)) as f64;
    let through = named(&found.features, "looked_inside");
    let body = &found.solution.body;
    let is_seen = |k: usize| !found.labels.of(Role::Flap(k)).is_empty();
    let in_plane = |k: usize| (body.get(layout::flap(k) + layout::FLAP_ANGLE) - FRAC_PI_2).abs() < IN_PLANE_RAD;
    inner + base < LEAST_INSIDE && through < amount(LEAST_INSIDE) && (0..4).filter(|&k| is_seen(k)).all(in_plane)
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, Isometry3};

    use super::super::evidence::Evidence;
    use super::super::labels::{Labels, Present};
    use super::*;
    use crate::fit::{FittedBody, Parameters, Solution};

    /// A side and a flap on it under an angle, with readings on the base, on inner faces and through the opening.
    fn found(angle_rad: f64, base: usize, inner: f64, through: f64) -> FoundBox {
        let mut numbers = Parameters::zeros();
        numbers[layout::flap(1) + layout::FLAP_ANGLE] = angle_rad;
        let body = FittedBody { input_from_object: Isometry3::identity(), numbers };
        let parts = vec![(Role::Base, vec![0; base]), (Role::Side(1), vec![0; 900]), (Role::Flap(1), vec![0; 900])];
        let present = Present { flaps: [false, true, false, false], ..Present::default() };
        let evidence = vec![(Role::Side(3), Evidence { met: inner, is_inner: true, ..Evidence::default() })];
        let solution = Solution { body, covariance: DMatrix::zeros(0, 0).into(), motions: Vec::new() };
        let one = FoundBox::unjudged(solution, present, Labels { parts, stride: 1 }, evidence, 1800.0);
        FoundBox { features: vec![("looked_inside", amount(through))], ..one }
    }

    #[test]
    fn an_inside_or_a_flap_out_of_its_sides_plane_tells_an_open_box() {
        assert!(may_be_closed(&found(FRAC_PI_2 + 0.1, 0, 0.0, 0.0)));
        assert!(may_be_closed(&found(FRAC_PI_2, 40, 40.0, 80.0)));
        for open in [
            found(FRAC_PI_2 + 0.4, 0, 0.0, 0.0),
            found(FRAC_PI_2, 200, 0.0, 0.0),
            found(FRAC_PI_2, 0, 200.0, 0.0),
            found(FRAC_PI_2, 0, 0.0, 200.0),
        ] {
            assert!(!may_be_closed(&open), "{open:?}");
        }
    }
}
