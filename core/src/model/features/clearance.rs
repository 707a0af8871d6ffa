use super::bounded;
use crate::model::SegmentSet;
use crate::perception::EdgeKind;

/// phi 4 (eq. 65): `tolerance - height of the lowest edge over the support`, metres, never below `-tolerance`; 0 where that
/// edge was cut off by something nearer or by the frame, for then nobody saw how far down the segment goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Clearance {
    pub tolerance_m: f64,
}

impl Clearance {
    pub fn value(&self, set: &SegmentSet, s: usize) -> f64 {
        let k = set.rectangles[s].lowest_edge(&set.up);
        if matches!(set.edges[s][k], EdgeKind::Occluded | EdgeKind::Border) {
            return 0.0;
        }
        let height_m = set.rectangles[s].edge_height(k, &set.up) - set.foot.dot(&set.up);
        bounded(self.tolerance_m, height_m.abs())
    }
}
