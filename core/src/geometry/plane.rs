use super::Vec3;

/// The plane `normal . p = distance`; the normal has unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub normal: Vec3,
    /// Metres.
    pub distance: f64,
}

impl Plane {
    /// Metres above the plane, on the side that its normal points to.
    pub fn height_of(&self, point: &Vec3) -> f64 {
        self.normal.dot(point) - self.distance
    }

    pub fn flipped(&self) -> Self {
        Self { normal: -self.normal, distance: -self.distance }
    }
}
