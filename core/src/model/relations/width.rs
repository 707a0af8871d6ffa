use crate::model::SegmentSet;

/// Gamma 8 (eq. 70): 1 less the relative difference of the lengths of the two rectangles' most level edges: a flap is as wide
/// as its side, and opposite sides are alike.
pub fn value(set: &SegmentSet, a: usize, b: usize) -> f64 {
    let width_m = |s: usize| {
        let rectangle = &set.rectangles[s];
        let [first, second] = [0, 1].map(|k| (rectangle.corners[k + 1] - rectangle.corners[k], rectangle.size()[k]));
        // The flatter of the two directions, by slope.
        let slope = |(along, length): &(crate::geometry::Vec3, f64)| along.dot(&set.up).abs() / length.max(1e-12);
        if slope(&first) <= slope(&second) {
            first.1
        } else {
            second.1
        }
    };
    let (a, b) = (width_m(a), width_m(b));
    1.0 - (a - b).abs() / a.max(b).max(1e-12)
}
