//! Cholesky's factor of a body's curvature: what hangs on one side knows nothing of what hangs on another.

use nalgebra::DMatrix;

use super::body::Parameters;
use super::layout::{bulge, flap, tuck, BULGE, FLAP_COUNT, PARAMETER_COUNT, TUCK_COUNT};

const COUNT: usize = PARAMETER_COUNT;

/// The parameter of each row: side by side the numbers of one side's panels, then those that all share.
const ORDER: [usize; COUNT] = order();

const fn order() -> [usize; COUNT] {
    let mut out = [0; COUNT];
    let (mut row, mut k) = (0, 0);
    while k < 4 {
        let mut i = 0;
        while i < TUCK_COUNT {
            out[row] = tuck(k) + i;
            (row, i) = (row + 1, i + 1);
        }
        i = 0;
        while i < FLAP_COUNT {
            out[row] = flap(k) + i;
            (row, i) = (row + 1, i + 1);
        }
        out[row] = bulge(k);
        (row, k) = (row + 1, k + 1);
    }
    let mut shared = 0;
    while shared < BULGE {
        out[row] = shared;
        (row, shared) = (row + 1, shared + 1);
    }
    out
}

/// A lower triangle, each row kept from its first entry that is not 0: the factor has none before either.
#[derive(Debug, Clone)]
pub struct Factor {
    rows: Box<[[f64; COUNT]]>,
    first: [usize; COUNT],
}

impl Factor {
    /// Of the curvature (lower triangle) with its diagonal raised by that share; `None` where it is not positive definite.
    pub fn new(curvature: &DMatrix<f64>, damping: f64) -> Option<Self> {
        let mut out = Self { rows: vec![[0.0; COUNT]; COUNT].into(), first: [0; COUNT] };
        for i in 0..COUNT {
            let row = &mut out.rows[i];
            for j in 0..=i {
                let (a, b) = (ORDER[i].max(ORDER[j]), ORDER[i].min(ORDER[j]));
                row[j] = curvature[(a, b)];
            }
            row[i] *= 1.0 + damping;
            out.first[i] = row[..i].iter().position(|value| *value != 0.0).unwrap_or(i);
        }
        for i in 0..COUNT {
            let (before, from) = out.rows.split_at_mut(i);
            let row = &mut from[0];
            for j in out.first[i]..i {
                let start = out.first[i].max(out.first[j]);
                row[j] = (row[j] - dot(&row[start..j], &before[j][start..j])) / before[j][j];
            }
            let square = row[i] - dot(&row[out.first[i]..i], &row[out.first[i]..i]);
            if square.is_nan() || square <= 0.0 {
                return None;
            }
            row[i] = square.sqrt();
        }
        Some(out)
    }

    /// What, times the matrix, is this.
    pub fn solve(&self, right: &Parameters) -> Parameters {
        let mut x: [f64; COUNT] = std::array::from_fn(|i| right[ORDER[i]]);
        for i in 0..COUNT {
            let (first, row) = (self.first[i], &self.rows[i]);
            x[i] = (x[i] - dot(&row[first..i], &x[first..i])) / row[i];
        }
        for i in (0..COUNT).rev() {
            let (first, row) = (self.first[i], &self.rows[i]);
            x[i] /= row[i];
            let value = x[i];
            for (other, by) in x[first..i].iter_mut().zip(&row[first..i]) {
                *other -= value * by;
            }
        }
        let mut out = Parameters::zeros();
        (0..COUNT).for_each(|i| out[ORDER[i]] = x[i]);
        out
    }

    /// The matrix's inverse.
    pub fn inverse(&self) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(COUNT, COUNT);
        for place in 0..COUNT {
            let mut one = Parameters::zeros();
            one[place] = 1.0;
            let column = self.solve(&one);
            // Rounding leaves the two halves unlike.
            (place..COUNT).for_each(|row| {
                out[(row, place)] = column[row];
                out[(place, row)] = column[row];
            });
        }
        out
    }
}

/// Side by side in four sums: one waits for each of its additions.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (fours, others) = (a.chunks_exact(4).zip(b.chunks_exact(4)), a.len() / 4 * 4);
    for (a, b) in fours {
        (0..4).for_each(|lane| sums[lane] += a[lane] * b[lane]);
    }
    let rest: f64 = a[others..].iter().zip(&b[others..]).map(|(x, y)| x * y).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    /// A positive definite matrix; without `is_full`, one in which sides know each other only by what all share.
    fn drawn(seed: u64, is_full: bool) -> DMatrix<f64> {
        let mut random = SplitMix64::new(seed);
        let mut out = DMatrix::identity(COUNT, COUNT);
        let side = |place: usize| (0..COUNT - BULGE).find(|&row| ORDER[row] == place).map(|row| row / 10);
        for _ in 0..60 {
            let of = (random.unit() * 4.0) as usize;
            let row = DMatrix::from_fn(COUNT, 1, |place, _| {
                let value = random.unit() - 0.5;
                if is_full || side(place).is_none_or(|k| k == of) {
                    value
                } else {
                    0.0
                }
            });
            out += &row * row.transpose();
        }
        out
    }

    #[test]
    fn it_solves_what_it_is_of_full_or_not() {
        let mut cases = 0;
        for seed in 0..20 {
            for is_full in [false, true] {
                let matrix = drawn(seed, is_full);
                let factor = Factor::new(&matrix.lower_triangle(), 0.0).unwrap();
                let right = Parameters::from_fn(|i, _| (i as f64 * 0.7 + seed as f64).sin());
                assert!((&matrix * factor.solve(&right) - right).amax() < 1e-9);
                assert!((&matrix * factor.inverse() - DMatrix::identity(COUNT, COUNT)).amax() < 1e-9);
                let last_of_sides = COUNT - BULGE - 1;
                assert_eq!(factor.first[last_of_sides] < 30, is_full);
                cases += 1;
            }
        }
        assert_eq!(cases, 40);
    }

    #[test]
    fn what_is_not_positive_definite_has_none() {
        let mut matrix = drawn(1, true);
        matrix[(7, 7)] = -1.0;
        assert!(Factor::new(&matrix, 0.0).is_none());
        matrix[(7, 7)] = f64::NAN;
        assert!(Factor::new(&matrix, 0.0).is_none());
    }
}
