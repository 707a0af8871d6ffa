use crate::geometry::{Moments, Vec3};

/// Steps in a metre: 15 micrometres each.
const STEPS_PER_M: f64 = 65_536.0;

/// Sums over readings of one surface, in whole steps about a place of its own: exact, so in any order the same.
#[derive(Debug, Clone, Copy)]
pub struct FixedFit {
    about: Vec3,
    count: u64,
    sum: [i64; 3],
    /// Sums of xx, xy, xz, yy, yz, zz.
    outer: [i128; 6],
}

impl FixedFit {
    pub fn about(place: &Vec3) -> Self {
        Self { about: *place, count: 0, sum: [0; 3], outer: [0; 6] }
    }

    #[inline]
    pub fn add(&mut self, p: &Vec3) {
        let along = |k: usize| ((p[k] - self.about[k]) * STEPS_PER_M) as i64;
        let [x, y, z] = [along(0), along(1), along(2)];
        self.count += 1;
        self.sum[0] += x;
        self.sum[1] += y;
        self.sum[2] += z;
        let products = [x * x, x * y, x * z, y * y, y * z, z * z];
        self.outer.iter_mut().zip(products).for_each(|(total, p)| *total += i128::from(p));
    }

    pub fn count(&self) -> usize {
        self.count as usize
    }

    /// Sums about the place, metres, and the place.
    pub fn moments(&self) -> (Moments, Vec3) {
        let sum = Vec3::from(self.sum.map(|s| s as f64)) / STEPS_PER_M;
        let outer = self.outer.map(|o| o as f64 / (STEPS_PER_M * STEPS_PER_M));
        (Moments::from_sums(self.count as f64, sum, outer), self.about)
    }
}
