use super::oriented_box::OrientedBox;
use crate::geometry::Vec3;

/// All that is within a radius of a segment, in the base's frame, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Capsule {
    pub from: Vec3,
    pub to: Vec3,
    pub radius_m: f64,
}

/// All that lies below a plane: `normal . p <= distance_m`, the normal of unit length, away from what is solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfSpace {
    pub normal: Vec3,
    pub distance_m: f64,
}

/// What the arm may not run into.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    Box(OrientedBox),
    Capsule(Capsule),
    HalfSpace(HalfSpace),
}
