//! Smooth random fields over the image: independent values on a lattice, interpolated.

use crate::random::{uniform, Stream};

/// Zero mean, unit variance on average over the cell, correlated over about `cell_px` pixels.
pub struct Field {
    seed: u64,
    stream: Stream,
    cell_px: f64,
}

impl Field {
    pub fn new(seed: u64, stream: Stream, cell_px: f64) -> Self {
        Self { seed, stream, cell_px }
    }

    pub fn at(&self, u: usize, v: usize) -> f64 {
        let (x, y) = (u as f64 / self.cell_px, v as f64 / self.cell_px);
        let (fx, fy) = (smooth(x.fract()), smooth(y.fract()));
        let (i, j) = (x as u64, y as u64);
        let weights = [(1.0 - fx) * (1.0 - fy), fx * (1.0 - fy), (1.0 - fx) * fy, fx * fy];
        let nodes = [self.node(i, j), self.node(i + 1, j), self.node(i, j + 1), self.node(i + 1, j + 1)];
        let mixed: f64 = weights.iter().zip(nodes).map(|(w, n)| w * n).sum();
        // Interpolation lowers the variance between the nodes: undo it.
        mixed / weights.iter().map(|w| w * w).sum::<f64>().sqrt()
    }

    /// Uniform on the lattice, scaled to unit variance.
    fn node(&self, i: u64, j: u64) -> f64 {
        (uniform(self.seed, self.stream, (j << 32) | i) - 0.5) * 12f64.sqrt()
    }
}

fn smooth(t: f64) -> f64 {
    t * t * (3.0 - 2.0 * t)
}
