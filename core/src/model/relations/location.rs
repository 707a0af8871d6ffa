use crate::geometry::angles::angle_between_rad;
use crate::model::features::Direction;
use crate::model::SegmentSet;

/// Gamma 2 (eq. 6): `tolerance - angle(center a - center b, direction)`, radians: the first part lies towards `direction` of the second.
#[derive(Debug, Clone, PartialEq)]
pub struct RelativeLocation {
    pub direction: Direction,
    pub tolerance_rad: f64,
}

impl RelativeLocation {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        let direction = match self.direction {
            Direction::Up => &set.up,
        };
        self.tolerance_rad - angle_between_rad(&(set.centers[a] - set.centers[b]), direction)
    }
}
