use wide::f32x4;

/// Nearer than this is no reading of a depth camera, metres.
pub const NEAREST_M: f32 = 0.05;
/// Farther than this, or farther aside, neither.
pub const FARTHEST_M: f32 = 1e4;

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
    /// No readings.
    pub const NONE: Self = Self { seen: f32x4::ZERO, u: f32x4::ZERO, v: f32x4::ZERO, q: f32x4::ZERO };

    /// From the coordinates of four pixels and one value more: four whole loads and a transposition. Gathering single
    /// values would stall each vector on its own stores.
    #[inline]
    pub fn new(coordinates: &[f32; 3 * QUAD + 1]) -> Self {
        let at = |k: usize| -> [f32; QUAD] { std::array::from_fn(|c| coordinates[3 * k + c]) };
        let [x, y, z, _] = f32x4::transpose([at(0), at(1), at(2), at(3)].map(f32x4::new));
        Self::of(x, y, z)
    }

    #[inline]
    fn of(x: f32x4, y: f32x4, z: f32x4) -> Self {
        let far = f32x4::splat(FARTHEST_M);
        // NaN compares false with everything.
        let seen = z.simd_gt(f32x4::splat(NEAREST_M)) & z.simd_lt(far) & x.abs().simd_lt(far) & y.abs().simd_lt(far);
        let q = f32x4::splat(1.0) / z;
        Self { seen, u: (x * q) & seen, v: (y * q) & seen, q: q & seen }
    }

    /// From the pixels `start..end` of a row; those past the end are no readings.
    #[cold]
    pub fn cut(points: &[[f32; 3]], start: usize, end: usize) -> Self {
        let pixel = |k: usize| if start + k < end { points[start + k] } else { [f32::NAN; 3] };
        let axis = |c: usize| f32x4::new(std::array::from_fn(|k| pixel(k)[c]));
        Self::of(axis(0), axis(1), axis(2))
    }
}
