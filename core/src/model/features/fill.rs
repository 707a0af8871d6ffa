use crate::model::SegmentSet;

/// phi 5 (eq. 66): the share of the segment's rectangle that its hull fills; board is cut square, clutter seldom is.
pub fn value(set: &SegmentSet, s: usize) -> f64 {
    set.fills[s]
}
