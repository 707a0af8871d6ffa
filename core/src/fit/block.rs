//! The sums of one part's rows.

use super::layout::{place_of_slot, SLOT_COUNT};
use super::linearized::Linearized;
use super::row::Row;

/// Half of Cauchy's loss of a residual in standard deviations is the logarithm of this times half of the cut's square; the weight that
/// it leaves the residual is its inverse.
pub fn cauchy_ratio(residual: f64, cut: f64) -> f64 {
    1.0 + (residual / cut).powi(2)
}

/// A product of more of them may be too large a number with the next.
const MOST_RATIOS: f64 = 1e150;
/// Rows wait for so many others: the sums then stay in registers while all of them are added.
const WAITING: usize = 8;
/// The curvature is summed by squares of so many slots.
const TILE: usize = 4;
/// Slots in whole tiles.
const PADDED: usize = SLOT_COUNT.div_ceil(TILE) * TILE;

/// The sums of one part, by the first `COUNT` slots.
pub struct Block<const COUNT: usize> {
    cost: f64,
    /// Ratios of the loss that share what their logarithms count: one is taken of their product.
    ratios: f64,
    of_ratios: f64,
    gradient: [f64; COUNT],
    /// Lower triangle, in whole tiles.
    curvature: [[f64; PADDED]; PADDED],
    /// Rows that are not yet in the curvature, with their weighted ones.
    rows: [[f64; PADDED]; WAITING],
    weighted: [[f64; PADDED]; WAITING],
    waiting: usize,
}

impl<const COUNT: usize> Default for Block<COUNT> {
    fn default() -> Self {
        Self {
            cost: 0.0,
            ratios: 1.0,
            of_ratios: 0.0,
            gradient: [0.0; COUNT],
            curvature: [[0.0; PADDED]; PADDED],
            rows: [[0.0; PADDED]; WAITING],
            weighted: [[0.0; PADDED]; WAITING],
            waiting: 0,
        }
    }
}

impl<const COUNT: usize> Block<COUNT> {
    pub fn add(&mut self, row: &Row, sigma: f64, information: f64, cut: f64) {
        let ratio = cauchy_ratio(row.value / sigma, cut);
        let (of_ratio, left) = (information * 0.5 * cut * cut, 1.0 / ratio);
        if of_ratio != self.of_ratios || self.ratios > MOST_RATIOS {
            self.take_ratios();
            self.of_ratios = of_ratio;
        }
        self.ratios *= ratio;
        let weight = information * left / (sigma * sigma);
        let (kept, weighted) = (&mut self.rows[self.waiting], &mut self.weighted[self.waiting]);
        for i in 0..COUNT {
            kept[i] = row.slots[i];
            weighted[i] = weight * row.slots[i];
            self.gradient[i] += weighted[i] * row.value;
        }
        self.waiting += 1;
        if self.waiting == WAITING {
            self.add_waiting();
        }
    }

    /// Row by row in their order, whatever the tile: the same bits as one by one.
    fn add_waiting(&mut self) {
        for i in (0..COUNT).step_by(TILE) {
            for j in (0..=i).step_by(TILE) {
                let mut tile: [[f64; TILE]; TILE] = std::array::from_fn(|a| *part_of(&self.curvature[i + a], j));
                for (row, weighted) in self.rows.iter().zip(&self.weighted).take(self.waiting) {
                    let (row, weighted) = (part_of(row, j), part_of(weighted, i));
                    for a in 0..TILE {
                        for b in 0..TILE {
                            tile[a][b] += weighted[a] * row[b];
                        }
                    }
                }
                for (a, sums) in tile.iter().enumerate() {
                    self.curvature[i + a][j..j + TILE].copy_from_slice(sums);
                }
            }
        }
        self.waiting = 0;
    }

    fn take_ratios(&mut self) {
        self.cost += self.of_ratios * self.ratios.ln();
        self.ratios = 1.0;
    }

    /// Into the sums of all parts, as side `k`'s.
    pub fn scatter(&mut self, sums: &mut Linearized, k: usize) {
        self.add_waiting();
        self.take_ratios();
        sums.cost += self.cost;
        for i in 0..COUNT {
            let place = place_of_slot(i, k);
            sums.gradient[place] += self.gradient[i];
            // Places ascend with their slots.
            for j in 0..=i {
                sums.curvature[(place, place_of_slot(j, k))] += self.curvature[i][j];
            }
        }
    }
}

/// As many slots as a tile has: there are whole tiles of them.
#[inline(always)]
fn part_of(row: &[f64; PADDED], from: usize) -> &[f64; TILE] {
    &row.as_chunks().0[from / TILE]
}
