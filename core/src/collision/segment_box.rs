//! A segment and a box in the box's own frame: how far apart, or how deep inside.

use crate::geometry::Vec3;

/// Directions shorter than this (relative to the segment's length) are no separating axes: the faces' stand for them.
const PARALLEL: f64 = 1e-9;

/// Distance between a segment and a box of those half sizes about the origin, 0 where they meet.
pub fn distance_m(from: &Vec3, to: &Vec3, half_m: &Vec3) -> f64 {
    let along = to - from;
    let outside = |t: f64| {
        let point = from + along * t;
        point
            - Vec3::new(
                point.x.clamp(-half_m.x, half_m.x),
                point.y.clamp(-half_m.y, half_m.y),
                point.z.clamp(-half_m.z, half_m.z),
            )
    };
    // The squared distance is convex in t and a parabola between the crossings of the six faces' planes: its slope, which only
    // grows, is followed to where it is zero.
    let slope = |t: f64| along.dot(&outside(t));
    let (mut low, mut high) = ((0.0, slope(0.0)), (1.0, slope(1.0)));
    if low.1 >= 0.0 {
        return outside(0.0).norm();
    }
    if high.1 <= 0.0 {
        return outside(1.0).norm();
    }
    for axis in 0..3 {
        if along[axis] == 0.0 {
            continue;
        }
        for face in [-half_m[axis], half_m[axis]] {
            let t = (face - from[axis]) / along[axis];
            if t > low.0 && t < high.0 {
                let found = (t, slope(t));
                if found.1 < 0.0 {
                    low = found;
                } else {
                    high = found;
                }
            }
        }
    }
    let t = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
    outside(t).norm()
}

/// The least shift that takes a segment out of a box which it meets: separating axes of faces, and of the segment with each edge.
pub fn depth_m(from: &Vec3, to: &Vec3, half_m: &Vec3) -> f64 {
    let (low, high) = (from.inf(to), from.sup(to));
    let faces = (half_m - low).inf(&(high + half_m));
    let mut depth = faces.min();
    let along = to - from;
    for axis in 0..3 {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let length = along[i].hypot(along[j]);
        if length > PARALLEL * along.norm() {
            let aside = (from[i] * along[j] - from[j] * along[i]).abs() / length;
            let extent = (half_m[i] * along[j].abs() + half_m[j] * along[i].abs()) / length;
            depth = depth.min(extent - aside);
        }
    }
    depth.max(0.0)
}
