use super::quads::{Quad, QUAD};
use super::ray_moments::RayMoments;
use super::rays::Rays;
use std::ops::Range;
use wide::f32x4;

/// Side of a cell, pixels: small enough that a panel of 500 pixels has whole ones.
pub const CELL_PX: usize = QUAD;
/// Readings of a full cell.
pub const FULL: f64 = (CELL_PX * CELL_PX) as f64;

/// Moments of all cells of the image, row by row, with a frame of empty cells around, so that every cell of the image has
/// eight neighbours; its last column and row may be cut.
pub struct Cells {
    /// With the frame.
    pub columns: usize,
    pub rows: usize,
    pub moments: Vec<RayMoments>,
}

impl Cells {
    pub fn new(rays: &Rays) -> Self {
        let (columns, rows) = (rays.width.div_ceil(CELL_PX) + 2, rays.height.div_ceil(CELL_PX) + 2);
        let mut moments = Vec::with_capacity(columns * rows);
        moments.resize(columns, RayMoments::default());
        for y in (0..rays.height).step_by(CELL_PX) {
            let y_end = (y + CELL_PX).min(rays.height);
            moments.push(RayMoments::default());
            for x in (0..rays.width).step_by(CELL_PX) {
                moments.push(cell_moments(rays, x, y..y_end));
            }
            moments.push(RayMoments::default());
        }
        moments.resize(columns * rows, RayMoments::default());
        Self { columns, rows, moments }
    }

    pub fn len(&self) -> usize {
        self.moments.len()
    }

    /// The cells beside a cell of the image: left, right, above, below.
    pub fn beside(&self, cell: usize) -> [usize; 4] {
        [cell - 1, cell + 1, cell - self.columns, cell + self.columns]
    }

    /// The cells of the image, row by row.
    pub fn of_image(&self) -> impl Iterator<Item = usize> + '_ {
        (1..self.rows - 1).flat_map(|row| row * self.columns + 1..(row + 1) * self.columns - 1)
    }

    /// First column and the rows of a cell's pixels.
    pub fn place(&self, cell: usize, rays: &Rays) -> (usize, Range<usize>) {
        let (x, y) = ((cell % self.columns - 1) * CELL_PX, (cell / self.columns - 1) * CELL_PX);
        (x, y..(y + CELL_PX).min(rays.height))
    }
}

/// In single precision about the cell's mean, four pixels at a time, then shifted in double.
fn cell_moments(rays: &Rays, x: usize, rows: Range<usize>) -> RayMoments {
    let mut lines = [Quad::NONE; CELL_PX];
    for (line, y) in lines.iter_mut().zip(rows) {
        *line = rays.quad(x, y);
    }
    let mut firsts = [f32x4::ZERO; 4];
    for line in &lines {
        for (sum, term) in firsts.iter_mut().zip([line.seen & f32x4::ONE, line.u, line.v, line.q]) {
            *sum += term;
        }
    }
    let totals = sums_over_lanes(firsts);
    let n = totals.to_array()[0];
    if n == 0.0 {
        return RayMoments::default();
    }
    let [_, u0, v0, q0] = (totals / f32x4::splat(n)).to_array();
    let (u_zero, v_zero, q_zero) = (f32x4::splat(u0), f32x4::splat(v0), f32x4::splat(q0));
    let mut sums = [f32x4::ZERO; 9];
    for line in &lines {
        let seen = line.seen;
        let (u, v, q) = ((line.u - u_zero) & seen, (line.v - v_zero) & seen, (line.q - q_zero) & seen);
        for (sum, term) in sums.iter_mut().zip([u, v, q, u * u, u * v, v * v, u * q, v * q, q * q]) {
            *sum += term;
        }
    }
    let [s0, s1, s2, s3, s4, s5, s6, s7, s8] = sums;
    let four = |sums: [f32x4; 4]| sums_over_lanes(sums).to_array().map(f64::from);
    let ([u, v, q, uu], [uv, vv, uq, vq]) = (four([s0, s1, s2, s3]), four([s4, s5, s6, s7]));
    let [qq, ..] = four([s8, f32x4::ZERO, f32x4::ZERO, f32x4::ZERO]);
    let [n, u0, v0, q0] = [n, u0, v0, q0].map(f64::from);
    RayMoments {
        n,
        u: u + n * u0,
        v: v + n * v0,
        q: q + n * q0,
        uu: uu + u0 * (2.0 * u + n * u0),
        uv: uv + u0 * v + v0 * (u + n * u0),
        vv: vv + v0 * (2.0 * v + n * v0),
        uq: uq + u0 * q + q0 * (u + n * u0),
        vq: vq + v0 * q + q0 * (v + n * v0),
        qq: qq + q0 * (2.0 * q + n * q0),
    }
}

/// The sum over the lanes of each of four vectors.
fn sums_over_lanes(of: [f32x4; 4]) -> f32x4 {
    let [a, b, c, d] = f32x4::transpose(of);
    (a + b) + (c + d)
}
