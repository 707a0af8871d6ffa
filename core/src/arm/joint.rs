use nalgebra::Matrix3;

use crate::geometry::{Rigid, Vec3};

/// A revolute joint: where it is on its parent link, and what it may do.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    pub name: String,
    pub lower_rad: f64,
    pub upper_rad: f64,
    pub speed_rad_per_s: f64,
    pub acceleration_rad_per_s2: f64,
    /// The joint's frame at position 0, on the link before it.
    pub parent_from_joint: Rigid,
    /// Unit vector in the joint's frame; positions grow by the right hand about it.
    pub axis: Vec3,
    /// The link's rotation on its parent at position q is `still + sin * sin(q) + cos * cos(q)`.
    still: Matrix3<f64>,
    sin: Matrix3<f64>,
    cos: Matrix3<f64>,
}

/// What a joint may do: position, speed and acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    pub lower_rad: f64,
    pub upper_rad: f64,
    pub speed_rad_per_s: f64,
    pub acceleration_rad_per_s2: f64,
}

impl Joint {
    pub fn new(name: String, parent_from_joint: Rigid, axis: Vec3, limits: Limits) -> Self {
        let along = axis * axis.transpose();
        let rotation = parent_from_joint.rotation;
        Self {
            name,
            lower_rad: limits.lower_rad,
            upper_rad: limits.upper_rad,
            speed_rad_per_s: limits.speed_rad_per_s,
            acceleration_rad_per_s2: limits.acceleration_rad_per_s2,
            parent_from_joint,
            axis,
            still: rotation * along,
            sin: rotation * axis.cross_matrix(),
            cos: rotation * (Matrix3::identity() - along),
        }
    }

    /// The joint's link, turned to a position, on the link before it.
    pub fn parent_from_link(&self, position_rad: f64) -> Rigid {
        let (sin, cos) = position_rad.sin_cos();
        Rigid::new(self.still + self.sin * sin + self.cos * cos, self.parent_from_joint.translation)
    }

    pub fn allows(&self, position_rad: f64) -> bool {
        (self.lower_rad..=self.upper_rad).contains(&position_rad)
    }
}
