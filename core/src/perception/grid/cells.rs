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

/// In single precision about one of the cell's readings, four pixels at a time, then shifted in double.
fn cell_moments(rays: &Rays, x: usize, rows: Range<usize>) -> RayMoments {
    let (y, count) = (rows.start, rows.len());
    let lines: [Quad; CELL_PX] = std::array::from_fn(|k| rays.quad(x, y + k.min(count - 1)));
    let lines = &lines[..count];
    let Some([u0, v0, q0]) = reference(lines) else { return RayMoments::default() };
    let (u_zero, v_zero, q_zero) = (f32x4::splat(u0), f32x4::splat(v0), f32x4::splat(q0));
    let mut sums = [f32x4::ZERO; 10];
    for line in lines {
        let seen = line.seen;
        let (u, v, q) = ((line.u - u_zero) & seen, (line.v - v_zero) & seen, (line.q - q_zero) & seen);
        let terms = [seen & f32x4::ONE, u, v, q, u * u, u * v, v * v, u * q, v * q, q * q];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += term;
        }
    }
    let [n, u, v, q, uu, uv, vv, uq, vq, qq] = sums.map(|s| {
        let [a, b, c, d] = s.to_array();
        f64::from((a + b) + (c + d))
    });
    let [u0, v0, q0] = [f64::from(u0), f64::from(v0), f64::from(q0)];
    RayMoments {
        n,
        u: u + n * u0,
        v: v + n * v0,
        q: q + n * q0,
        uu: uu + 2.0 * u0 * u + n * u0 * u0,
        uv: uv + u0 * v + v0 * u + n * u0 * v0,
        vv: vv + 2.0 * v0 * v + n * v0 * v0,
        uq: uq + u0 * q + q0 * u + n * u0 * q0,
        vq: vq + v0 * q + q0 * v + n * v0 * q0,
        qq: qq + 2.0 * q0 * q + n * q0 * q0,
    }
}

/// u, v and q of the first reading.
fn reference(lines: &[Quad]) -> Option<[f32; 3]> {
    lines.iter().find_map(|line| {
        let lane = line.seen.to_bitmask().trailing_zeros() as usize;
        let pick = |values: f32x4| values.to_array()[lane];
        (lane < QUAD).then(|| [pick(line.u), pick(line.v), pick(line.q)])
    })
}
