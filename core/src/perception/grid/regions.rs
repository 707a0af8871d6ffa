use super::cells::{Cells, CELL_PX};
use super::noise::{sum_of_square, Noise};
use super::ray_moments::{RayMoments, RayPlane};

pub const NONE: u16 = u16::MAX;
/// Sides of the squares that regions begin with, in cells, one after the other.
const SEED_CELLS: [usize; 4] = [6, 4, 3, 2];
/// A seed is flat where its rms is below this many sigmas, and this full.
const SEED_SIGMAS: f64 = 1.3;
const SEED_FULL_SHARE: f64 = 0.6;
/// A cell joins where its readings' rms and mean distance from the plane are below these many sigmas.
const CELL_SIGMAS: f64 = 1.75;
const MEAN_SIGMAS: f64 = 1.2;
/// Readings of a cell, at least.
const MIN_CELL_READINGS: f64 = 4.0;
/// The plane is fitted anew when the region has grown by this factor.
const REFIT_GROWTH: f64 = 1.15;
/// How often the whole border is tried again with the last plane.
const RETRIES: usize = 3;
/// Readings of a region, at least.
const MIN_REGION_READINGS: f64 = 48.0;

/// Moments of the squares of two by two cells that begin in odd columns and rows: larger squares add them.
struct Pairs {
    columns: usize,
    moments: Vec<RayMoments>,
}

impl Pairs {
    fn new(cells: &Cells) -> Self {
        let columns = cells.columns / 2;
        let square = |k: usize| sum_of_square(cells, 2 * (k % columns) + 1, 2 * (k / columns) + 1, 2);
        let whole = |size: usize| (size - 1) / 2;
        let rows = whole(cells.rows);
        let is_whole = |k: &usize| k % columns < whole(cells.columns);
        let moments =
            (0..columns * rows).map(|k| if is_whole(&k) { square(k) } else { RayMoments::default() }).collect();
        Self { columns, moments }
    }

    /// Of the square of `side` cells, an even number, that begins in an odd column and row.
    fn sum(&self, column: usize, row: usize, side: usize) -> RayMoments {
        let mut sum = RayMoments::default();
        for y in row / 2..(row + side) / 2 {
            let start = y * self.columns + column / 2;
            self.moments[start..start + side / 2].iter().for_each(|m| sum.add(m));
        }
        sum
    }
}

/// A flat piece of the image.
#[derive(Debug, Clone)]
pub struct Region {
    pub moments: RayMoments,
    pub plane: RayPlane,
    pub cells: Vec<u32>,
}

/// All flat pieces, and whose each cell is.
pub struct Regions {
    pub list: Vec<Region>,
    pub owner: Vec<u16>,
}

impl Regions {
    /// Regions grown from the flattest squares, large squares first.
    pub fn grow(cells: &Cells, noise: &Noise) -> Self {
        let mut regions = Self { list: Vec::new(), owner: vec![NONE; cells.len()] };
        let pairs = Pairs::new(cells);
        for side in SEED_CELLS {
            for seed in regions.seeds(cells, &pairs, noise, side) {
                if regions.list.len() + 1 < usize::from(NONE) && regions.is_free(cells, seed, side) {
                    regions.grow_from(cells, noise, seed, side);
                }
            }
        }
        regions
    }

    /// First cells of free, flat squares, flattest first.
    fn seeds(&self, cells: &Cells, pairs: &Pairs, noise: &Noise, side: usize) -> Vec<usize> {
        let least = SEED_FULL_SHARE * (side * CELL_PX).pow(2) as f64;
        let mut found: Vec<(f64, usize)> = Vec::new();
        let step = side.div_ceil(3);
        for row in (1..cells.rows.saturating_sub(side)).step_by(step) {
            for column in (1..cells.columns.saturating_sub(side)).step_by(step) {
                let first = row * cells.columns + column;
                if self.owner[first] != NONE || !self.is_free(cells, first, side) {
                    continue;
                }
                let sum =
                    if step == 2 { pairs.sum(column, row, side) } else { sum_of_square(cells, column, row, side) };
                if sum.n < least {
                    continue;
                }
                let Some((plane, squares)) = sum.fit() else { continue };
                let expected = noise.variance_on(&plane) + noise.bias_variance(sum.q / sum.n);
                let roughness = squares / (sum.n * expected);
                if roughness < SEED_SIGMAS * SEED_SIGMAS {
                    found.push((roughness, first));
                }
            }
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.into_iter().map(|(_, first)| first).collect()
    }

    fn is_free(&self, cells: &Cells, first: usize, side: usize) -> bool {
        (0..side).all(|y| self.owner[first + y * cells.columns..][..side].iter().all(|&o| o == NONE))
    }

    fn grow_from(&mut self, cells: &Cells, noise: &Noise, first: usize, side: usize) {
        let id = self.list.len() as u16;
        let seed = (0..side * side).map(|k| (first + k / side * cells.columns + k % side) as u32);
        let mut region = Region { moments: RayMoments::default(), plane: RayPlane::default(), cells: seed.collect() };
        for &cell in &region.cells {
            region.moments.add(&cells.moments[cell as usize]);
            self.owner[cell as usize] = id;
        }
        let Some((plane, _)) = region.moments.fit() else { return self.release(&region.cells) };
        region.plane = plane;
        let mut variance = noise.variance_on(&region.plane);
        // Cells beside the region that were looked at but did not fit: the plane may come to them later.
        let mut refused: Vec<u32> = Vec::new();
        let (mut looked, mut fitted_at, mut retries) = (0, region.moments.n, RETRIES);
        loop {
            let layer_end = region.cells.len();
            for k in looked..layer_end {
                for next in cells.beside(region.cells[k] as usize) {
                    if self.owner[next] != NONE {
                        continue;
                    }
                    if fits(&cells.moments[next], &region.plane, variance, noise) {
                        self.owner[next] = id;
                        region.cells.push(next as u32);
                        region.moments.add(&cells.moments[next]);
                    } else {
                        refused.push(next as u32);
                    }
                }
            }
            looked = layer_end;
            let is_last = looked == region.cells.len();
            if region.moments.n > fitted_at * REFIT_GROWTH || (is_last && region.moments.n > fitted_at) {
                if let Some((plane, _)) = region.moments.fit() {
                    region.plane = plane;
                    variance = noise.variance_on(&plane);
                }
                fitted_at = region.moments.n;
            } else if is_last {
                break;
            }
            if is_last {
                if retries == 0 {
                    break;
                }
                retries -= 1;
                for next in std::mem::take(&mut refused) {
                    if self.owner[next as usize] != NONE {
                        continue;
                    }
                    if fits(&cells.moments[next as usize], &region.plane, variance, noise) {
                        self.owner[next as usize] = id;
                        region.cells.push(next);
                        region.moments.add(&cells.moments[next as usize]);
                    } else {
                        refused.push(next);
                    }
                }
            }
        }
        self.keep_what_fits(cells, noise, region);
    }

    /// The plane may have moved since a cell joined.
    fn keep_what_fits(&mut self, cells: &Cells, noise: &Noise, mut region: Region) {
        let (plane, owner) = (region.plane, &mut self.owner);
        let mut moments = region.moments;
        let variance = noise.variance_on(&plane);
        region.cells.retain(|&cell| {
            let of_cell = &cells.moments[cell as usize];
            let stays = fits(of_cell, &plane, variance, noise);
            if !stays {
                moments.remove(of_cell);
                owner[cell as usize] = NONE;
            }
            stays
        });
        region.moments = moments;
        match moments.fit() {
            Some((plane, _)) if moments.n >= MIN_REGION_READINGS => {
                region.plane = plane;
                self.list.push(region);
            }
            _ => self.release(&region.cells),
        }
    }

    fn release(&mut self, cells: &[u32]) {
        cells.iter().for_each(|&cell| self.owner[cell as usize] = NONE);
    }
}

/// Whether a cell's readings lie on the plane (eq. 54).
fn fits(cell: &RayMoments, plane: &RayPlane, variance_on_plane: f64, noise: &Noise) -> bool {
    if cell.n < MIN_CELL_READINGS {
        return false;
    }
    let variance = variance_on_plane + noise.bias_variance(cell.q / cell.n);
    cell.mean_about(plane).powi(2) < MEAN_SIGMAS * MEAN_SIGMAS * variance
        && cell.squares_about(plane) < cell.n * CELL_SIGMAS * CELL_SIGMAS * variance
}
