//! Which parts of a fitted body are sure enough to be told.

use super::evidence::Sheet;
use super::found_box::FINE_M;
use super::labels::{Labels, Present};
use super::lean::lean;
use super::sight::Sight;
use crate::fit::{layout, FittedBody, Role};

/// Readings of other surfaces lean more than this off the panel that they were given to: the tangent.
const MOST_LEAN: f64 = 0.35;
/// Parts of fewer readings are not called seen.
const LEAST_READINGS: usize = 120;

/// Parts whose readings are few, or lie across them, and what hangs on a flap that has none though it would show.
pub fn drop_unsure(sight: &Sight, body: &FittedBody, labels: &mut Labels) {
    let stride = labels.stride;
    for (role, points) in &mut labels.parts {
        let leans = || lean(sight, body, *role, points).is_none_or(|lean| lean > MOST_LEAN);
        if points.len() * stride * stride < LEAST_READINGS || leans() {
            points.clear();
        }
    }
    for k in 0..4 {
        let is_edge_on = || Sheet::new(body, Role::Flap(k), &sight.eye).look(sight, FINE_M).is_edge_on();
        if labels.of(Role::Flap(k)).is_empty() && !labels.of(Role::Tuck(k)).is_empty() && !is_edge_on() {
            labels.clear(Role::Tuck(k));
        }
    }
}

/// A flap shorter than this is none.
const LEAST_FLAP_M: f64 = 0.012;

/// Without flaps that the fit has made vanish.
pub fn long_enough(body: &FittedBody, present: &Present) -> Present {
    let mut out = *present;
    for k in 0..4 {
        out.flaps[k] &= body.get(layout::flap(k) + layout::FLAP_LENGTH) > LEAST_FLAP_M;
        out.tucks[k] &= out.flaps[k] && body.get(layout::tuck(k) + layout::TUCK_LENGTH) > LEAST_FLAP_M;
    }
    out
}
