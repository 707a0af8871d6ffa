use super::connectivity::edge_distance_m;
use crate::model::features::bounded;
use crate::model::SegmentSet;

/// Gamma 7 (eq. 69): `tolerance - distance between the second part's highest edge and the nearest edge of the first`, metres,
/// never below `-tolerance`: a flap hangs on the top of its side.
#[derive(Debug, Clone, PartialEq)]
pub struct Hinge {
    pub tolerance_m: f64,
}

impl Hinge {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        let top = set.rectangles[b].edge(set.rectangles[b].highest_edge(&set.up));
        let distances = (0..4).map(|k| edge_distance_m(set.rectangles[a].edge(k), top));
        bounded(self.tolerance_m, distances.fold(f64::INFINITY, f64::min))
    }
}
