use crate::geometry::angles::angle_between_lines_rad;
use crate::model::SegmentSet;

/// gamma 5 (eq. 9): `tolerance - angle(normal a, normal b)`, radians, normals without a sign.
#[derive(Debug, Clone, PartialEq)]
pub struct Parallel {
    pub tolerance_rad: f64,
}

impl Parallel {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        self.tolerance_rad - angle_between_lines_rad(&set.planes[a].normal, &set.planes[b].normal)
    }
}
