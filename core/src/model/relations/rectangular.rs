use crate::geometry::angles::angle_between_lines_rad;
use crate::geometry::Vec3;
use crate::model::SegmentSet;

/// gamma 4 (eq. 8): `tolerance - mean angle` between the vectors that join associated corners of two opposite sides and
/// both sides' normals, radians, under the best pairing of corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Rectangular {
    pub tolerance_rad: f64,
}

impl Rectangular {
    pub fn value(&self, set: &SegmentSet, a: usize, b: usize) -> f64 {
        let normals = [&set.planes[a].normal, &set.planes[b].normal];
        let (corners_a, corners_b) = (&set.rectangles[a].corners, &set.rectangles[b].corners);
        let best = pairings()
            .map(|pairing| mean_angle_rad(corners_a, corners_b, pairing, normals))
            .fold(f64::INFINITY, f64::min);
        self.tolerance_rad - best
    }
}

/// The eight ways in which two rectangles' corners go round together.
fn pairings() -> impl Iterator<Item = [usize; 4]> {
    (0..4usize).flat_map(|shift| {
        let forward = [0, 1, 2, 3].map(|k: usize| (k + shift) % 4);
        let backward = [0, 1, 2, 3].map(|k: usize| (shift + 4 - k) % 4);
        [forward, backward]
    })
}

fn mean_angle_rad(a: &[Vec3; 4], b: &[Vec3; 4], pairing: [usize; 4], normals: [&Vec3; 2]) -> f64 {
    let vectors = (0..4).map(|k| b[pairing[k]] - a[k]);
    vectors.map(|v| normals.iter().map(|n| angle_between_lines_rad(&v, n)).sum::<f64>()).sum::<f64>() / 8.0
}
