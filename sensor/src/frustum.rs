//! A bundle of rays from one point: what one tile of the image can see.

use crate::vector::Vec3;

/// All points with z above the apex's whose slopes (x - apex x) / z and (y - apex y) / z lie in intervals, up to a depth.
/// The apex has z = 0.
#[derive(Clone, Copy)]
pub struct Frustum {
    apex: Vec3,
    slopes: [(f64, f64); 2],
    far_m: f64,
}

impl Frustum {
    /// Around the rays from `apex` to some points; nothing for no points.
    pub fn around(apex: Vec3, points: impl Iterator<Item = Vec3>) -> Option<Self> {
        let nothing = (f64::INFINITY, f64::NEG_INFINITY);
        let mut bundle = Self { apex, slopes: [nothing; 2], far_m: 0.0 };
        for p in points {
            for k in 0..2 {
                let slope = (p[k] - apex[k]) / p[2];
                bundle.slopes[k] = (bundle.slopes[k].0.min(slope), bundle.slopes[k].1.max(slope));
            }
            bundle.far_m = bundle.far_m.max(p[2]);
        }
        (bundle.far_m > 0.0).then_some(bundle)
    }

    /// The same bundle without an end.
    pub fn endless(self) -> Self {
        Self { far_m: f64::INFINITY, ..self }
    }

    /// True only if no ray of the bundle meets the box before its end.
    pub fn misses(&self, lo: [f32; 3], hi: [f32; 3]) -> bool {
        let (near_z, far_z) = (f64::from(lo[2]).max(0.0), f64::from(hi[2]));
        if far_z < 0.0 || near_z > self.far_m {
            return true;
        }
        (0..2).any(|k| {
            let (low, high) = self.slopes[k];
            let (a, b) = (f64::from(lo[k]) - self.apex[k], f64::from(hi[k]) - self.apex[k]);
            // The box lies beyond a slope where even its corner nearest to that side does; a hair for rounding.
            a - (high * near_z).max(high * far_z) > 1e-9 || b - (low * near_z).min(low * far_z) < -1e-9
        })
    }
}
