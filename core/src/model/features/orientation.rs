use serde::Deserialize;

use crate::geometry::angles::{angle_between_lines_rad, angle_between_rad};
use crate::model::SegmentSet;

/// phi 1 (eq. 2): `tolerance - |angle - angle(normal, direction)|`, radians. The paper's is `angle = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Orientation {
    pub direction: Direction,
    pub angle_rad: f64,
    pub tolerance_rad: f64,
    /// Tell the two faces of a segment apart where a viewpoint orients its normal.
    pub oriented: bool,
}

/// The unit vector u.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    Up,
}

impl Orientation {
    pub fn value(&self, set: &SegmentSet, s: usize) -> f64 {
        let direction = match self.direction {
            Direction::Up => &set.up,
        };
        let normal = &set.planes[s].normal;
        let angle_rad = if self.oriented && set.oriented {
            angle_between_rad(normal, direction)
        } else {
            angle_between_lines_rad(normal, direction)
        };
        self.tolerance_rad - (self.angle_rad - angle_rad).abs()
    }
}
