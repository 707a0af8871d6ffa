use super::cells::Cells;
use super::noise::Noise;
use super::ray_moments::RayMoments;
use super::rays::Rays;
use super::regions::{Regions, NONE};

/// A reading belongs to a plane within this many sigmas.
const READING_SIGMAS: f64 = 2.6;
/// How far, in cells, a region reaches beyond its own cells.
const REACH_CELLS: usize = 3;
/// Readings that make a cell pass a region on to the next.
const MIN_PASSED: usize = 4;

/// Whose each pixel is, and the moments of each region's readings.
pub struct PixelLabels {
    pub labels: Vec<u16>,
    pub moments: Vec<RayMoments>,
}

impl PixelLabels {
    /// Interiors whole; at the borders each reading goes to the plane that it fits best among those that are near.
    pub fn refine(rays: &Rays, cells: &Cells, regions: &Regions, noise: &Noise) -> Self {
        let mut out = Self {
            labels: vec![NONE; rays.inverse_depth.len()],
            moments: vec![RayMoments::default(); regions.list.len()],
        };
        let mut border = Vec::new();
        for cell in 0..cells.len() {
            let own = regions.owner[cell];
            let is_interior = own != NONE && cells.around(cell).all(|c| regions.owner[c] == own);
            if is_interior {
                out.take_whole(rays, cells, cell, own);
            } else if own != NONE || cells.around(cell).any(|c| regions.owner[c] != NONE) {
                border.push(cell as u32);
            }
        }
        let mut near = Near::new(regions, &border);
        for _ in 0..REACH_CELLS {
            for &cell in &border {
                out.take_best(rays, cells, regions, noise, cell as usize, &mut near);
            }
            border = near.next(cells);
        }
        out
    }

    fn take_whole(&mut self, rays: &Rays, cells: &Cells, cell: usize, region: u16) {
        for pixel in cells.pixels(cell, rays) {
            if rays.is_reading(pixel) {
                self.labels[pixel] = region;
            }
        }
        self.moments[usize::from(region)].add(&cells.moments[cell]);
    }

    fn take_best(
        &mut self,
        rays: &Rays,
        cells: &Cells,
        regions: &Regions,
        noise: &Noise,
        cell: usize,
        near: &mut Near,
    ) {
        let mut candidates = [(NONE, 0usize, 0.0); 9];
        let mut count = 0;
        for c in cells.around(cell).chain([cell]) {
            let owner = near.owner[c];
            if owner != NONE && !candidates[..count].iter().any(|k| k.0 == owner) {
                candidates[count] = (owner, 0, noise.variance_on(&regions.list[usize::from(owner)].plane));
                count += 1;
            }
        }
        let candidates = &mut candidates[..count];
        for pixel in cells.pixels(cell, rays) {
            if !rays.is_reading(pixel) {
                continue;
            }
            let [u, v, q] = rays.ray(pixel);
            let bias = noise.bias_variance(q);
            let mut best = (READING_SIGMAS * READING_SIGMAS, usize::MAX);
            for (k, &(region, _, variance)) in candidates.iter().enumerate() {
                let off = q - regions.list[usize::from(region)].plane.inverse_depth(u, v);
                let squared_sigmas = off * off / (variance + bias);
                if squared_sigmas < best.0 {
                    best = (squared_sigmas, k);
                }
            }
            if let Some((region, taken, _)) = candidates.get_mut(best.1) {
                self.labels[pixel] = *region;
                self.moments[usize::from(*region)].add_reading(u, v, q);
                *taken += 1;
            }
        }
        let most = candidates.iter().fold((NONE, 0), |best, c| if c.1 > best.1 { (c.0, c.1) } else { best });
        if near.owner[cell] == NONE && most.1 >= MIN_PASSED {
            near.passed.push((cell as u32, most.0));
        }
    }
}

/// Which region a cell near a border hands on.
struct Near {
    owner: Vec<u16>,
    touched: Vec<bool>,
    passed: Vec<(u32, u16)>,
}

impl Near {
    fn new(regions: &Regions, border: &[u32]) -> Self {
        let mut touched = vec![false; regions.owner.len()];
        border.iter().for_each(|&cell| touched[cell as usize] = true);
        Self { owner: regions.owner.clone(), touched, passed: Vec::new() }
    }

    /// The untouched cells beside those that were just passed on.
    fn next(&mut self, cells: &Cells) -> Vec<u32> {
        let mut next = Vec::new();
        for (cell, region) in std::mem::take(&mut self.passed) {
            self.owner[cell as usize] = region;
            for c in cells.beside(cell as usize) {
                if self.owner[c] == NONE && !self.touched[c] {
                    self.touched[c] = true;
                    next.push(c as u32);
                }
            }
        }
        next
    }
}
