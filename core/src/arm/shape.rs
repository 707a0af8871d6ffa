use crate::geometry::{Rigid, Vec3};

/// A convex piece of a body, in that body's frame, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// All that is within `radius_m` of the segment between two points.
    Capsule { from_m: Vec3, to_m: Vec3, radius_m: f64 },
    /// A box by its centre's frame and half its sizes along x, y and z.
    Box { body_from_box: Rigid, half_m: Vec3 },
}
