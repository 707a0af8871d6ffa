use super::cells::{Cells, CELL_PX, FULL};
use super::noise::Noise;
use super::quads::QUAD;
use super::ray_moments::RayPlane;
use super::rays::Rays;
use super::regions::{Regions, NONE};
use wide::f32x4;

/// A reading belongs to a plane within this many sigmas.
const READING_SIGMAS: f32 = 2.6;
/// How far, in cells, a region reaches beyond its own cells.
const REACH_CELLS: usize = 3;
/// Readings that make a cell pass a region on to the next.
const MIN_PASSED: usize = 4;
/// Slot 0 for none, nine for the regions around a cell, itself included; a power of two spares the bounds' checks.
const NEAR_SLOTS: usize = 16;

/// Whose each pixel is: interiors whole; at the borders each reading goes to the plane that it fits best among those near.
pub fn refine(rays: &Rays, cells: &Cells, regions: &Regions, noise: &Noise) -> Vec<u16> {
    let models = regions.list.iter().map(|r| Model::new(&r.plane, noise)).collect();
    let mut work = Refinement {
        rays,
        cells,
        regions,
        models,
        bias: f32x4::splat(noise.bias_variance(1.0) as f32),
        owner: regions.owner.clone(),
        labels: vec![NONE; rays.points.len()],
    };
    let mut border = work.take_interiors();
    let mut touched = vec![false; cells.len()];
    border.iter().for_each(|&cell| touched[cell as usize] = true);
    for _ in 0..REACH_CELLS {
        let mut passed = Vec::new();
        for &cell in &border {
            passed.extend(work.take_best(cell as usize).map(|region| (cell, region)));
        }
        border = work.beyond(&passed, &mut touched);
    }
    work.labels
}

/// A region's plane, ready for four pixels at a time.
struct Model {
    a: f32x4,
    b: f32x4,
    c: f32x4,
    /// Of a reading on the plane, slow errors left out.
    variance: f32x4,
}

impl Model {
    fn new(plane: &RayPlane, noise: &Noise) -> Self {
        let splat = |value: f64| f32x4::splat(value as f32);
        let variance = splat(noise.variance_on(plane));
        Self { a: splat(plane.a), b: splat(plane.b), c: splat(plane.c), variance }
    }
}

/// The regions around a cell, from slot 1 on.
struct Near {
    slots: [u16; NEAR_SLOTS],
    count: usize,
}

impl Near {
    fn regions(&self) -> &[u16] {
        &self.slots[1..=self.count]
    }
}

struct Refinement<'a> {
    rays: &'a Rays<'a>,
    cells: &'a Cells,
    regions: &'a Regions,
    models: Vec<Model>,
    /// Variance by slow errors at q = 1.
    bias: f32x4,
    /// As of the regions, and of the cells that were passed on since.
    owner: Vec<u16>,
    labels: Vec<u16>,
}

impl Refinement<'_> {
    /// Takes whole the cells amid their region; returns those at its border.
    fn take_interiors(&mut self) -> Vec<u32> {
        let mut border = Vec::new();
        for cell in self.cells.of_image() {
            let own = self.regions.owner[cell];
            if !self.around(cell).iter().flatten().all(|&o| o == own) {
                border.push(cell as u32);
            } else if own != NONE {
                self.take_whole(cell, own);
            }
        }
        border
    }

    fn take_whole(&mut self, cell: usize, region: u16) {
        let (x, rows) = self.cells.place(cell, self.rays);
        let is_full = self.cells.moments[cell].n == FULL;
        for y in rows {
            let start = y * self.rays.width + x;
            if is_full {
                // One store instead of a call: cells are narrow.
                if let Some(line) = self.labels[start..].first_chunk_mut::<CELL_PX>() {
                    *line = [region; CELL_PX];
                }
            } else {
                let seen = self.rays.quad(x, y).seen.to_bitmask();
                (0..QUAD).filter(|lane| seen >> lane & 1 == 1).for_each(|lane| self.labels[start + lane] = region);
            }
        }
    }

    /// Gives each reading of a cell to the best plane around; the region to pass on where the cell was nobody's.
    fn take_best(&mut self, cell: usize) -> Option<u16> {
        let near = self.near(cell);
        let mut taken = [0usize; NEAR_SLOTS];
        let (x, rows) = self.cells.place(cell, self.rays);
        for y in rows {
            let quad = self.rays.quad(x, y);
            let bias = self.bias * quad.q * quad.q;
            let mut least = f32x4::splat(READING_SIGMAS * READING_SIGMAS);
            let mut best = f32x4::ZERO;
            for (slot, &region) in near.regions().iter().enumerate() {
                let Model { a, b, c, variance } = &self.models[usize::from(region)];
                let off = quad.q - (*a * quad.u + *b * quad.v + *c);
                let squared_sigmas = off * off / (*variance + bias);
                let better = squared_sigmas.simd_lt(least) & quad.seen;
                least = better.bitselect(squared_sigmas, least);
                best = better.bitselect(f32x4::splat((slot + 1) as f32), best);
            }
            let slots = best.fast_trunc_int().to_array().map(|slot| slot as usize % NEAR_SLOTS);
            slots.iter().for_each(|&slot| taken[slot] += 1);
            let start = y * self.rays.width + x;
            let line = &mut self.labels[start..(start + QUAD).min((y + 1) * self.rays.width)];
            match line.first_chunk_mut::<QUAD>() {
                Some(whole) => *whole = slots.map(|slot| near.slots[slot]),
                None => line.iter_mut().zip(slots).for_each(|(label, slot)| *label = near.slots[slot]),
            }
        }
        let most = (1..=near.count).fold(1, |best, slot| if taken[slot] > taken[best] { slot } else { best });
        (self.regions.owner[cell] == NONE && taken[most] >= MIN_PASSED).then(|| near.slots[most])
    }

    fn around(&self, cell: usize) -> [[u16; 3]; 3] {
        let corner = cell - self.cells.columns - 1;
        std::array::from_fn(|y| {
            let line = &self.owner[corner + y * self.cells.columns..][..3];
            [line[0], line[1], line[2]]
        })
    }

    /// The regions around a cell.
    fn near(&self, cell: usize) -> Near {
        let mut near = Near { slots: [NONE; NEAR_SLOTS], count: 0 };
        for &owner in self.around(cell).iter().flatten() {
            if owner != NONE && !near.regions().contains(&owner) {
                near.count += 1;
                near.slots[near.count] = owner;
            }
        }
        near
    }

    /// The untouched cells beside those that were just passed on.
    fn beyond(&mut self, passed: &[(u32, u16)], touched: &mut [bool]) -> Vec<u32> {
        let mut next = Vec::new();
        for &(cell, region) in passed {
            self.owner[cell as usize] = region;
            for c in self.cells.beside(cell as usize) {
                if self.regions.owner[c] == NONE && !touched[c] && self.cells.moments[c].n > 0.0 {
                    touched[c] = true;
                    next.push(c as u32);
                }
            }
        }
        next
    }
}
