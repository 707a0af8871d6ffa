//! No box reaches into what it stands on.

use nalgebra::{Translation3, UnitQuaternion};

use crate::fit::{layout, FittedBody};
use crate::geometry::Vec3;

/// Deeper than the noise, metres.
const SUNK_M: f64 = 0.006;
/// A box that leans more does not stand on the support with its whole base (cosine).
pub const LEVEL_COS: f64 = 0.9994;

/// The body with its walls cut off at the support, where they reach into it; its rim stays. Level frame.
pub fn settled(body: &FittedBody) -> FittedBody {
    let depth = -lowest_m(body);
    if depth < SUNK_M {
        return body.clone();
    }
    let mut out = body.clone();
    let up = body.input_from_object.rotation * Vec3::z();
    if up.z > LEVEL_COS {
        let rim = body.to_input(&(Vec3::z() * body.get(layout::HEIGHT)));
        let turn = UnitQuaternion::rotation_between(&up, &Vec3::z()).unwrap_or_default();
        out.input_from_object.rotation = turn * body.input_from_object.rotation;
        out.input_from_object.translation = Translation3::new(rim.x, rim.y, 0.0);
        out.numbers[layout::HEIGHT] = rim.z;
    } else {
        let cut = depth / up.z;
        out.input_from_object.translation.vector += up * cut;
        out.numbers[layout::HEIGHT] -= cut;
    }
    out
}

/// Whether a body still reaches into the support: it is no box.
pub fn is_sunk(body: &FittedBody) -> bool {
    -lowest_m(body) > 2.0 * SUNK_M
}

/// Height of its lowest corner over the support.
pub fn lowest_m(body: &FittedBody) -> f64 {
    let (l, w) = (body.get(layout::LENGTH) / 2.0, body.get(layout::WIDTH) / 2.0);
    let corners = [[-l, -w], [l, -w], [l, w], [-l, w]];
    corners.iter().map(|[x, y]| body.to_input(&Vec3::new(*x, *y, 0.0)).z).fold(f64::INFINITY, f64::min)
}
