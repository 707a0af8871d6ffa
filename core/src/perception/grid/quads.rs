use super::rays::{FARTHEST_M, NEAREST_M};
use wide::f32x4;

/// Pixels that are looked at together: the width of the processor's smallest vectors.
pub const QUAD: usize = 4;

/// Four neighbouring pixels of a row: rays `(u, v, 1)` and inverse depths q, all nought where there is no reading.
#[derive(Clone, Copy)]
pub struct Quad {
    /// All bits set where there is a reading.
    pub seen: f32x4,
    pub u: f32x4,
    pub v: f32x4,
    pub q: f32x4,
}

impl Quad {
    pub fn new(points: &[[f32; 3]; QUAD]) -> Self {
        let axis = |k: usize| f32x4::new([points[0][k], points[1][k], points[2][k], points[3][k]]);
        let (x, y, z) = (axis(0), axis(1), axis(2));
        let far = f32x4::splat(FARTHEST_M);
        // NaN compares false with everything.
        let seen = z.simd_gt(f32x4::splat(NEAREST_M)) & z.simd_lt(far) & x.abs().simd_lt(far) & y.abs().simd_lt(far);
        let q = f32x4::splat(1.0) / z;
        Self { seen, u: (x * q) & seen, v: (y * q) & seen, q: q & seen }
    }

    /// From the pixels `start..end` of a row; those past the end are no readings.
    pub fn cut(points: &[[f32; 3]], start: usize, end: usize) -> Self {
        Self::new(&std::array::from_fn(|k| if start + k < end { points[start + k] } else { [f32::NAN; 3] }))
    }
}
