use super::shape::Shape;
use crate::geometry::{Rigid, Vec3};

/// A parallel-plate gripper on the flange: a body, and two fingers that move along y. All in the flange's frame, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gripper {
    pub mass_kg: f64,
    pub body_size_m: Vec3,
    pub finger_size_m: Vec3,
    /// The least and the widest free gap between the fingers.
    pub opening_m: [f64; 2],
    /// The tool's origin; its axes are the flange's.
    pub tool_point_m: Vec3,
}

impl Gripper {
    pub fn flange_from_tool(&self) -> Rigid {
        Rigid::shift(self.tool_point_m)
    }

    pub fn body(&self) -> Shape {
        upright_box(Vec3::z() * (self.body_size_m.z / 2.0), self.body_size_m)
    }

    /// The finger on the +y side, then the other, at a free gap of `opening_m`.
    pub fn fingers(&self, opening_m: f64) -> [Shape; 2] {
        let z = self.body_size_m.z + self.finger_size_m.z / 2.0;
        let y = (opening_m + self.finger_size_m.y) / 2.0;
        [y, -y].map(|y| upright_box(Vec3::new(0.0, y, z), self.finger_size_m))
    }
}

fn upright_box(centre_m: Vec3, size_m: Vec3) -> Shape {
    Shape::Box { body_from_box: Rigid::shift(centre_m), half_m: size_m / 2.0 }
}
