use crate::model::SegmentSet;

/// phi 6 (eq. 67): the segment's area among that of all segments of the set: an object explains most of its group.
pub fn value(set: &SegmentSet, s: usize) -> f64 {
    let total: f64 = set.rectangles.iter().map(|rectangle| rectangle.area()).sum();
    if total > 0.0 {
        set.rectangles[s].area() / total
    } else {
        0.0
    }
}
