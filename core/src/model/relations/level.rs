use crate::model::features::bounded;
use crate::model::SegmentSet;

/// Gamma 6 (eq. 68): `tolerance - difference of the heights of the two highest edges`, metres, never below `-tolerance`: a
/// box has one rim.
#[derive(Debug, Clone, PartialEq)]
pub struct Level {
    pub tolerance_m: f64,
}

impl Level {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        let top = |s: usize| set.rectangles[s].edge_height(set.rectangles[s].highest_edge(&set.up), &set.up);
        bounded(self.tolerance_m, (top(a) - top(b)).abs())
    }
}
