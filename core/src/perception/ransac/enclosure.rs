use crate::geometry::{convex_hull, hull_contains, Point2};

/// Directions in which something must stand around an enclosed place.
const DIRECTIONS: usize = 24;
/// Of those directions, the share in which it must.
const MIN_SHARE: f64 = 0.7;
/// Side of a footprint cell, metres; finer than the narrowest box.
const CELL_M: f64 = 0.012;
/// Things this far away enclose no more, metres.
const REACH_M: f64 = 0.8;
/// Of a patch's points, the share that must lie inside the outline.
const MIN_INSIDE_SHARE: f64 = 0.8;
/// Points of a patch that are looked at.
const SAMPLES: usize = 48;
/// Cells of the footprint along one axis, at most: no box is larger.
const MAX_CELLS: usize = 400;

/// What stands around places on the support: the footprint of one group.
pub struct Enclosure {
    hull: Vec<Point2>,
    margin_m: f64,
    low: Point2,
    size: [usize; 2],
    taken: Vec<bool>,
}

impl Enclosure {
    /// `None` for a footprint without area or beyond the size of a box.
    pub fn new(footprint: &[Point2], margin_m: f64) -> Option<Self> {
        let hull = convex_hull(footprint);
        if hull.len() < 3 {
            return None;
        }
        let bound = |k: usize, pick: fn(f64, f64) -> f64| hull.iter().map(|p| p[k]).reduce(pick).unwrap_or_default();
        let low = [bound(0, f64::min), bound(1, f64::min)];
        let size = [0, 1].map(|k| ((bound(k, f64::max) - low[k]) / CELL_M) as usize + 1);
        if size[0].max(size[1]) > MAX_CELLS {
            return None;
        }
        let mut all = Self { hull, margin_m, low, size, taken: vec![false; size[0] * size[1]] };
        for p in footprint {
            if let Some(cell) = all.cell_of(p) {
                all.taken[cell] = true;
            }
        }
        Some(all)
    }

    /// Whether most of a patch lies inside the outline and something stands around it on nearly all sides (eq. 33).
    pub fn encloses(&self, patch: &[Point2]) -> bool {
        let sample = patch.iter().step_by(1 + patch.len() / SAMPLES);
        let inside: Vec<&Point2> = sample.clone().filter(|p| hull_contains(&self.hull, p, self.margin_m)).collect();
        if inside.is_empty() || (inside.len() as f64) < MIN_INSIDE_SHARE * sample.count() as f64 {
            return false;
        }
        let share = inside.iter().map(|p| self.share_around(p)).sum::<f64>() / inside.len() as f64;
        share >= MIN_SHARE
    }

    fn share_around(&self, from: &Point2) -> f64 {
        let blocked = |k: usize| {
            let (s, c) = (std::f64::consts::TAU * k as f64 / DIRECTIONS as f64).sin_cos();
            let steps = (REACH_M / CELL_M) as usize;
            let at = |n: usize| [from[0] + CELL_M * n as f64 * c, from[1] + CELL_M * n as f64 * s];
            (1..steps).map_while(|n| self.cell_of(&at(n))).any(|cell| self.taken[cell])
        };
        (0..DIRECTIONS).filter(|&k| blocked(k)).count() as f64 / DIRECTIONS as f64
    }

    fn cell_of(&self, p: &Point2) -> Option<usize> {
        let (x, y) = ((p[0] - self.low[0]) / CELL_M, (p[1] - self.low[1]) / CELL_M);
        let inside = x >= 0.0 && y >= 0.0 && x < self.size[0] as f64 && y < self.size[1] as f64;
        inside.then(|| x as usize + self.size[0] * y as usize)
    }
}
