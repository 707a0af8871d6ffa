use crate::model::features::bounded;
use crate::model::SegmentSet;

/// Gamma 9 (eq. 71): `tolerance - how far each rectangle reaches through the other's plane`, metres, the farther of the two,
/// never below `-tolerance`: walls end at each other, they do not cross.
#[derive(Debug, Clone, PartialEq)]
pub struct Aside {
    pub tolerance_m: f64,
}

impl Aside {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        bounded(self.tolerance_m, through_m(set, a, b).max(through_m(set, b, a)))
    }
}

/// What lies of rectangle `b` on the smaller of the two sides of the plane of `a`, metres.
fn through_m(set: &SegmentSet, a: usize, b: usize) -> f64 {
    let heights = set.rectangles[b].corners.map(|corner| set.planes[a].height_of(&corner));
    let (low, high) = heights.iter().fold((0.0f64, 0.0f64), |(low, high), &h| (low.min(h), high.max(h)));
    high.min(-low)
}
