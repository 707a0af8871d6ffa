//! What an open box shows that a closed one does not: its inside, or a flap out of the plane of its side.

use std::f64::consts::FRAC_PI_2;

use super::features::{amount, named};
use super::grow::FoundBox;
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
