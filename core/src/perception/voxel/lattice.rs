use super::bounds::Bounds;
use crate::geometry::Vec3;

/// Bits of a cell's place along one axis.
const AXIS_BITS: u32 = 21;
/// Cells along one axis, at most: one is left free at either end, so that every cell has neighbours.
const MAX_CELLS_PER_AXIS: f64 = ((1 << AXIS_BITS) - 4) as f64;
/// Bits of a place within a cell, along one axis.
const STEP_BITS: u32 = 8;
/// Steps of a cell along one axis.
pub const STEPS: f64 = (1 << STEP_BITS) as f64;

/// Cubes of space, numbered by their place.
#[derive(Debug, Clone, Copy)]
pub struct Lattice {
    low: Vec3,
    pub size_m: f64,
    steps_per_m: f64,
}

impl Lattice {
    /// Cubes of `size_m`, or larger where the bounds hold too many of them.
    pub fn new(bounds: &Bounds, size_m: f64) -> Self {
        let size_m = size_m.max(bounds.extent_m() / MAX_CELLS_PER_AXIS);
        Self { low: bounds.low, size_m, steps_per_m: STEPS / size_m }
    }

    /// The cube of a reading, and the steps from the cube's lowest corner to it.
    #[inline]
    pub fn locate(&self, p: &[f32; 3]) -> (u64, [u32; 3]) {
        let along = |k: usize| ((f64::from(p[k]) - self.low[k]) * self.steps_per_m) as u32;
        let at = [along(0), along(1), along(2)];
        let cell = at.map(|a| u64::from((a >> STEP_BITS) + 1));
        (cell[0] << (2 * AXIS_BITS) | cell[1] << AXIS_BITS | cell[2], at.map(|a| a & ((1 << STEP_BITS) - 1)))
    }

    /// What to add to a cube's number to go so many cubes along x and y.
    pub fn stride(dx: i64, dy: i64) -> i64 {
        (dx << (2 * AXIS_BITS)) + (dy << AXIS_BITS)
    }

    /// Middle of the lowest step of a cube, metres from the bounds' lowest corner.
    pub fn first_step(&self, key: u64) -> Vec3 {
        let axis = |k: u32| ((key >> (AXIS_BITS * k)) & ((1 << AXIS_BITS) - 1)) as f64;
        (Vec3::new(axis(2), axis(1), axis(0)) - Vec3::from([1.0; 3])) * self.size_m
            + Vec3::from([0.5 * self.step_m(); 3])
    }

    pub fn step_m(&self) -> f64 {
        self.size_m / STEPS
    }
}
