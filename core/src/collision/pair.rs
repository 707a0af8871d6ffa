//! Any two solids: one function for each pair of kinds.

use super::oriented_box::OrientedBox;
use super::solid::{Capsule, HalfSpace, Solid};
use super::{boxes, capsules, segment_box};

/// A segment that is no farther from a box than this meets it: rounding must not hide how deep.
const ROUNDING_M: f64 = 1e-12;

/// Metres between two solids; below 0 the least shift that parts them. Two half-spaces are not asked for: -infinity.
pub fn signed_distance_m(a: &Solid, b: &Solid) -> f64 {
    match (a, b) {
        (Solid::Capsule(a), Solid::Capsule(b)) => capsules::signed_distance_m(a, b),
        (Solid::Capsule(a), Solid::Box(b)) | (Solid::Box(b), Solid::Capsule(a)) => capsule_box_m(a, b),
        (Solid::Box(a), Solid::Box(b)) => boxes::signed_distance_m(a, b),
        (Solid::HalfSpace(plane), Solid::Capsule(a)) | (Solid::Capsule(a), Solid::HalfSpace(plane)) => {
            capsule_above_m(a, plane)
        }
        (Solid::HalfSpace(plane), Solid::Box(a)) | (Solid::Box(a), Solid::HalfSpace(plane)) => box_above_m(a, plane),
        (Solid::HalfSpace(_), Solid::HalfSpace(_)) => f64::NEG_INFINITY,
    }
}

/// The signed distance where it is below `bound_m`, else something that is no less than that; cheaper than the distance.
pub fn distance_unless_above_m(a: &Solid, b: &Solid, bound_m: f64) -> f64 {
    match (a, b) {
        (Solid::Box(a), Solid::Box(b)) => boxes::distance_unless_above_m(a, b, bound_m),
        _ => signed_distance_m(a, b),
    }
}

/// Whether two solids are at least `clearance_m` apart; never dearer than the distance.
pub fn clear_by(a: &Solid, b: &Solid, clearance_m: f64) -> bool {
    match (a, b) {
        (Solid::Box(a), Solid::Box(b)) => boxes::clear_by(a, b, clearance_m),
        _ => signed_distance_m(a, b) >= clearance_m,
    }
}

fn capsule_box_m(capsule: &Capsule, solid: &OrientedBox) -> f64 {
    let from = solid.base_from_box.apply_inverse(&capsule.from);
    let to = solid.base_from_box.apply_inverse(&capsule.to);
    let distance_m = segment_box::distance_m(&from, &to, &solid.half_m);
    if distance_m > ROUNDING_M {
        return distance_m - capsule.radius_m;
    }
    -segment_box::depth_m(&from, &to, &solid.half_m) - capsule.radius_m
}

fn capsule_above_m(capsule: &Capsule, plane: &HalfSpace) -> f64 {
    let lowest = plane.normal.dot(&capsule.from).min(plane.normal.dot(&capsule.to));
    lowest - plane.distance_m - capsule.radius_m
}

fn box_above_m(solid: &OrientedBox, plane: &HalfSpace) -> f64 {
    plane.normal.dot(&solid.centre()) - solid.half_extent_m(&plane.normal) - plane.distance_m
}
