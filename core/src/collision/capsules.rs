//! Two capsules: the distance of their segments, less the radii.

use super::solid::Capsule;

/// Segments shorter than this, squared, are points.
const POINT_SQ: f64 = 1e-24;

/// Signed: where the segments cross, the radii's sum is the least shift that parts the capsules.
pub fn signed_distance_m(a: &Capsule, b: &Capsule) -> f64 {
    segments_distance_m(a, b) - a.radius_m - b.radius_m
}

/// Closest points of two segments (C. Ericson, Real-Time Collision Detection, 5.1.9).
fn segments_distance_m(a: &Capsule, b: &Capsule) -> f64 {
    let (along_a, along_b, between) = (a.to - a.from, b.to - b.from, a.from - b.from);
    let (aa, bb, ab) = (along_a.norm_squared(), along_b.norm_squared(), along_a.dot(&along_b));
    let (a_between, b_between) = (along_a.dot(&between), along_b.dot(&between));
    let on_a = |t: f64| if aa > POINT_SQ { ((ab * t - a_between) / aa).clamp(0.0, 1.0) } else { 0.0 };
    let on_b = |s: f64| if bb > POINT_SQ { ((ab * s + b_between) / bb).clamp(0.0, 1.0) } else { 0.0 };
    let across = aa * bb - ab * ab;
    let start = if across > POINT_SQ { ((ab * b_between - a_between * bb) / across).clamp(0.0, 1.0) } else { 0.0 };
    let t = on_b(start);
    let s = on_a(t);
    (between + along_a * s - along_b * on_b(s)).norm()
}
