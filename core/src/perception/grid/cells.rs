use super::ray_moments::RayMoments;
use super::rays::Rays;

/// Side of a cell, pixels: small enough that a panel of 500 pixels has whole ones.
pub const CELL_PX: usize = 4;

/// Moments of all cells of the image, row by row; the last column and row may be cut.
pub struct Cells {
    pub columns: usize,
    pub rows: usize,
    pub moments: Vec<RayMoments>,
}

impl Cells {
    pub fn new(rays: &Rays) -> Self {
        let (columns, rows) = (rays.width.div_ceil(CELL_PX), rays.height.div_ceil(CELL_PX));
        let mut moments = vec![RayMoments::default(); columns * rows];
        for (row, out) in moments.chunks_exact_mut(columns).enumerate() {
            for (column, cell) in out.iter_mut().enumerate() {
                *cell = cell_moments(rays, column, row);
            }
        }
        Self { columns, rows, moments }
    }

    pub fn len(&self) -> usize {
        self.moments.len()
    }

    /// The cells beside a cell: left, right, above, below.
    pub fn beside(&self, cell: usize) -> impl Iterator<Item = usize> {
        let (column, columns, last) = (cell % self.columns, self.columns, self.len());
        let left = (column > 0).then(|| cell - 1);
        let right = (column + 1 < columns).then_some(cell + 1);
        let above = cell.checked_sub(columns);
        let below = (cell + columns < last).then_some(cell + columns);
        [left, right, above, below].into_iter().flatten()
    }

    /// The up to eight cells around a cell, row by row.
    pub fn around(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        let (column, row) = ((cell % self.columns) as isize, (cell / self.columns) as isize);
        (0..9).filter(|&k| k != 4).filter_map(move |k: isize| {
            let (x, y) = (column + k % 3 - 1, row + k / 3 - 1);
            let inside = x >= 0 && y >= 0 && x < self.columns as isize && y < self.rows as isize;
            inside.then(|| y as usize * self.columns + x as usize)
        })
    }

    /// The pixels of a cell, row by row.
    pub fn pixels(&self, cell: usize, rays: &Rays) -> impl Iterator<Item = usize> {
        let (x, y) = (cell % self.columns * CELL_PX, cell / self.columns * CELL_PX);
        let (x_end, y_end, width) = ((x + CELL_PX).min(rays.width), (y + CELL_PX).min(rays.height), rays.width);
        (y..y_end).flat_map(move |row| row * width + x..row * width + x_end)
    }
}

/// In single precision about the cell's first reading, so that four pixels go at a time, then shifted in double.
fn cell_moments(rays: &Rays, column: usize, row: usize) -> RayMoments {
    let (x, y) = (column * CELL_PX, row * CELL_PX);
    let (x_end, y_end) = ((x + CELL_PX).min(rays.width), (y + CELL_PX).min(rays.height));
    let pixel_of = |x: usize, y: usize| y * rays.width + x;
    let mut pixels = (y..y_end).flat_map(|y| (x..x_end).map(move |x| pixel_of(x, y)));
    let Some(first) = pixels.find(|&p| rays.is_reading(p)) else { return RayMoments::default() };
    let reference = rays.ray(first);
    let [u0, v0, q0] = reference.map(|c| c as f32);
    let mut sums = [[0f32; CELL_PX]; 10];
    for y in y..y_end {
        let start = pixel_of(x, y);
        let depth = &rays.inverse_depth[start..start + (x_end - x)];
        let points = &rays.points[start..start + (x_end - x)];
        for (lane, (&q, p)) in depth.iter().zip(points).enumerate() {
            let one = if q > 0.0 { 1.0f32 } else { 0.0 };
            // A missing reading's coordinates may be NaN: they must not be multiplied by nought.
            let (u, v, q) = if q > 0.0 { (p[0] * q - u0, p[1] * q - v0, q - q0) } else { (0.0, 0.0, 0.0) };
            let terms = [one, u, v, q, u * u, u * v, v * v, u * q, v * q, q * q];
            for (sum, term) in sums.iter_mut().zip(terms) {
                sum[lane] += term;
            }
        }
    }
    let [n, u, v, q, uu, uv, vv, uq, vq, qq] = sums.map(|s| f64::from((s[0] + s[1]) + (s[2] + s[3])));
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
