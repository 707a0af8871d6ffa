use crate::geometry::angles::angle_between_lines_rad;
use crate::model::SegmentSet;

/// Gamma 1 (eq. 5): `tolerance - |angle - angle(normal a, normal b)|`, radians, normals without a sign.
#[derive(Debug, Clone, PartialEq)]
pub struct RelativeOrientation {
    pub angle_rad: f64,
    pub tolerance_rad: f64,
}

impl RelativeOrientation {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        let angle_rad = angle_between_lines_rad(&set.planes[a].normal, &set.planes[b].normal);
        self.tolerance_rad - (self.angle_rad - angle_rad).abs()
    }
}
