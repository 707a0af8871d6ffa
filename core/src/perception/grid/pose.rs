use crate::geometry::{Plane, Vec3};
use nalgebra::Matrix3;

/// Where the camera stands: maps its coordinates to the input's.
#[derive(Debug, Clone, Copy)]
pub struct Pose {
    pub rotation: Matrix3<f64>,
    pub origin: Vec3,
}

impl Pose {
    pub fn point(&self, p: &Vec3) -> Vec3 {
        self.rotation * p + self.origin
    }

    pub fn plane(&self, plane: &Plane) -> Plane {
        let normal = self.rotation * plane.normal;
        Plane { normal, distance: plane.distance + normal.dot(&self.origin) }
    }
}
