use crate::geometry::{Rectangle, Vec3};
use crate::model::SegmentSet;

/// Gamma 3 (eq. 7): `tolerance - distance between the nearest edges of the two rectangles`, metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Connectivity {
    pub tolerance_m: f64,
}

impl Connectivity {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        self.tolerance_m - nearest_edge_distance_m(&set.rectangles[a], &set.rectangles[b])
    }
}

fn nearest_edge_distance_m(a: &Rectangle, b: &Rectangle) -> f64 {
    let pairs = (0..4).flat_map(|i| (0..4).map(move |j| (i, j)));
    pairs.map(|(i, j)| edge_distance_m(a.edge(i), b.edge(j))).fold(f64::INFINITY, f64::min)
}

/// Mean distance of the shorter edge's ends from the longer edge: 0 for a flap's edge on its side's edge, half a length where
/// two edges only meet at a corner.
pub fn edge_distance_m(a: (Vec3, Vec3), b: (Vec3, Vec3)) -> f64 {
    let (short, long) = if (a.1 - a.0).norm_squared() <= (b.1 - b.0).norm_squared() { (a, b) } else { (b, a) };
    (point_to_segment_m(&short.0, &long) + point_to_segment_m(&short.1, &long)) / 2.0
}

fn point_to_segment_m(point: &Vec3, segment: &(Vec3, Vec3)) -> f64 {
    let along = segment.1 - segment.0;
    let length_sq = along.norm_squared();
    let t = if length_sq > 0.0 { ((point - segment.0).dot(&along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    (point - (segment.0 + along * t)).norm()
}
