use super::lattice::Lattice;
use crate::geometry::{Moments, Vec3};

/// Readings of a cube beyond this number count no more: the sums would run over.
const MAX_COUNT: u32 = 1 << 24;

/// Number, sums and sums of products of places within one cube, in whole steps: exact, so in any order the same.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub struct FixedMoments {
    pub count: u32,
    sum: [u32; 3],
    /// Sums of xx, xy, xz, yy, yz, zz.
    outer: [u64; 6],
}

impl FixedMoments {
    #[inline]
    pub fn add(&mut self, [x, y, z]: [u32; 3]) {
        if self.count == MAX_COUNT {
            return;
        }
        self.count += 1;
        self.sum[0] += x;
        self.sum[1] += y;
        self.sum[2] += z;
        let products = [x * x, x * y, x * z, y * y, y * z, z * z];
        self.outer.iter_mut().zip(products).for_each(|(total, p)| *total += u64::from(p));
    }

    /// In metres from the lattice's lowest corner (eq. 46).
    pub fn to_moments(self, lattice: &Lattice, key: u64) -> Moments {
        let (origin, step_m, n) = (lattice.first_step(key), lattice.step_m(), f64::from(self.count));
        let sum = Vec3::from(self.sum.map(f64::from)) * step_m;
        let axes = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
        let mut outer = [0.0; 6];
        for (k, (a, b)) in axes.into_iter().enumerate() {
            let local = self.outer[k] as f64 * step_m * step_m;
            outer[k] = local + origin[a] * sum[b] + origin[b] * sum[a] + n * origin[a] * origin[b];
        }
        Moments::from_sums(n, sum + origin * n, outer)
    }
}
