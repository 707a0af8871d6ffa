//! A box as three pairs of planes, asked for many rays at once.

use wide::f32x4;

use super::proposal::Proposal;
use super::shell_look::ShellLook;

/// Every so many pixels of a row, and rows, are asked.
pub const STRIDE: usize = 8;
/// Pixels that a ray stands for.
pub const PIXELS: f64 = (STRIDE * STRIDE) as f64;
/// Proposals are off by this much beside the noise, metres.
pub const MODEL_M: f32 = 0.009;
/// What lies this near to the rim's plane, and over the opening, closes it.
const LID_M: f32 = 0.006;

/// Rays are looked at so many together.
pub const LANES: usize = 4;

/// Rays along a box's directions, side by side.
pub struct Lanes {
    pub rays: [f32x4; 3],
    pub inverses: [f32x4; 3],
}

pub fn lanes_of(of: &[f32], from: usize) -> f32x4 {
    let of = &of[from..from + LANES];
    f32x4::new([of[0], of[1], of[2], of[3]])
}

/// Followed by as many as are looked at together.
pub fn with_lanes(of: impl Iterator<Item = f64>) -> Vec<f32> {
    of.map(|value| value as f32).chain([f32::NAN; LANES]).collect()
}

/// What a ray says of a box that is open at the top. What meets a wall says twice its number, and one more on its inner face; else:
const NOTHING: f32 = 16.0;
const THROUGH: f32 = 17.0;
const HIDDEN: f32 = 18.0;
const LID: f32 = 19.0;
/// It meets the base.
const BASE: f32 = 20.0;
/// Added to what a ray says that ends below the opening, having come in by it.
const INSIDE: f32 = 32.0;
const KINDS: usize = 32;

/// How many rays say what.
pub struct Counts([u32; 2 * KINDS]);

impl Default for Counts {
    fn default() -> Self {
        Self([0; 2 * KINDS])
    }
}

impl Counts {
    pub fn add(&mut self, says: u32) {
        self.0[says as usize] += 1;
    }

    pub fn looked(&self) -> ShellLook {
        let either = |says: usize| f64::from(self.0[says] + self.0[says + KINDS]) * PIXELS;
        ShellLook {
            met: [0, 1, 2, 3].map(|wall| [either(2 * wall), either(2 * wall + 1)]),
            through: either(THROUGH as usize),
            hidden: either(HIDDEN as usize),
            lid: either(LID as usize),
            inside: self.0[KINDS..].iter().map(|count| f64::from(*count)).sum::<f64>() * PIXELS,
        }
    }
}

/// A box between three pairs of planes, as its rays see it from the eye.
pub struct Slabs {
    /// Along each axis, from the eye, metres.
    places: [[f32; 2]; 3],
}

impl Slabs {
    pub fn new(proposal: &Proposal, eye: &[f32; 3]) -> Self {
        let [x, y] = proposal.spans;
        let slabs = [x, y, proposal.heights];
        Self { places: std::array::from_fn(|axis| slabs[axis].map(|at| at as f32 - eye[axis])) }
    }

    /// The axis of the face by which a ray enters a closed box, and where, the reading being at 1.
    pub fn enter(&self, inverse: [f32; 3]) -> Option<(usize, f32)> {
        let (mut entry, mut exit) = ((0, f32::NEG_INFINITY), f32::INFINITY);
        for (axis, inverse) in inverse.into_iter().enumerate() {
            let [a, b] = self.places[axis].map(|at| at * inverse);
            if a.min(b) > entry.1 {
                entry = (axis, a.min(b));
            }
            exit = exit.min(a.max(b));
        }
        (entry.1 < exit && entry.1 > 0.0).then_some(entry)
    }

    /// What rays say of a box that is open at the top: each meets an outer face, or comes in from above and meets an inner one.
    pub fn meet(&self, lanes: &Lanes, tolerance: f32x4) -> [u32; LANES] {
        let (zero, splat) = (f32x4::ZERO, f32x4::splat);
        let slab = |axis: usize| {
            let [a, b] = self.places[axis].map(|at| splat(at) * lanes.inverses[axis]);
            (a.fast_min(b), a.fast_max(b))
        };
        let ([x, y, z], [from, to, (above, below)]) = (lanes.rays, [slab(0), slab(1), slab(2)]);
        let (entry, exit) = (from.0.fast_max(to.0), from.1.fast_min(to.1));
        let is_inner = above.simd_gt(entry);
        let is_y = is_inner.bitselect(to.1.simd_lt(from.1), to.0.simd_gt(from.0));
        let is_base = is_inner & below.simd_lt(exit);
        let at = is_base.bitselect(below, is_inner.bitselect(exit, entry));
        let first = entry.fast_max(above);
        // From below nothing is seen of the opening.
        let may_be_seen = is_inner.bitselect(z.simd_lt(zero), zero.simd_eq(zero));
        let is_any = first.simd_lt(exit.fast_min(below)) & first.simd_gt(zero) & may_be_seen;
        let along = is_base.bitselect(z, is_y.bitselect(y, x));
        let is_high = is_inner.bitselect(along.simd_gt(zero), along.simd_lt(zero));
        let reach = along.abs();
        let off = (splat(1.0) - at) * reach;
        let most = tolerance * reach + splat(MODEL_M);
        let over_opening = z - splat(self.places[2][1]);
        let closes = is_inner & over_opening.abs().simd_lt(splat(LID_M) + tolerance * z.abs());
        let is_inside = is_inner & over_opening.simd_lt(zero) & splat(INSIDE);
        let wall = (is_y & splat(4.0)) + (is_high & splat(2.0)) + (is_inner & splat(1.0));
        let face = is_base.bitselect(splat(BASE), wall);
        let says =
            off.simd_gt(most).bitselect(splat(THROUGH), off.simd_lt(-most).bitselect(splat(HIDDEN), face)) + is_inside;
        is_any.bitselect(closes.bitselect(splat(LID), says), splat(NOTHING)).to_array().map(|says| says as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::SplitMix64;

    const TOLERANCE: f64 = 0.004;

    /// One ray by itself: the face that it meets, in the order in which it comes to them. `None` where rounding may tell it otherwise.
    fn one_by_one(slabs: &[[f64; 2]; 3], ray: [f64; 3]) -> Option<f32> {
        let (mut entry, mut exit) = ((f64::NEG_INFINITY, 0), (f64::INFINITY, 0));
        let mut met: Vec<f64> = Vec::new();
        for axis in 0..3 {
            let (a, b) = (slabs[axis][0] / ray[axis], slabs[axis][1] / ray[axis]);
            let (near, far) = if a < b { (a, b) } else { (b, a) };
            entry = if near > entry.0 { (near, axis) } else { entry };
            exit = if far < exit.0 { (far, axis) } else { exit };
            met.extend([near, far]);
        }
        let is_close = |a: f64, b: f64| (a - b).abs() < 1e-4;
        if (0..6).any(|i| (0..i).any(|j| is_close(met[i], met[j]))) || is_close(entry.0, 0.0) {
            return None;
        }
        let is_inner = entry.1 == 2;
        if entry.0 >= exit.0 || entry.0 <= 0.0 || (is_inner && ray[2] > 0.0) {
            return Some(NOTHING);
        }
        let (at, axis) = if is_inner { exit } else { entry };
        let over = ray[2] - slabs[2][1];
        let lid = f64::from(LID_M) + TOLERANCE * ray[2].abs() - over.abs();
        if is_inner && lid > 1e-4 {
            return Some(LID);
        }
        let reach = ray[axis].abs();
        let (off, most) = ((1.0 - at) * reach, TOLERANCE * reach + f64::from(MODEL_M));
        if (is_inner && lid > -1e-4) || is_close(off.abs(), most) {
            return None;
        }
        let inside = if is_inner && over < 0.0 { INSIDE } else { 0.0 };
        let face = if axis == 2 {
            BASE
        } else {
            4.0 * axis as f32 + 2.0 * f32::from((ray[axis] > 0.0) == is_inner) + f32::from(is_inner)
        };
        Some(
            inside
                + if off > most {
                    THROUGH
                } else if off < -most {
                    HIDDEN
                } else {
                    face
                },
        )
    }

    #[test]
    fn four_together_say_what_each_says() {
        let mut random = SplitMix64::new(11);
        let mut draw = |low: f64, high: f64| low + random.unit() * (high - low);
        let (mut kinds, mut cases) = ([0; 2 * KINDS], 0);
        for _ in 0..3000 {
            // A box below and before the eye, rays to what lies about its faces.
            let (x, y, top) = (draw(-0.4, 0.4), draw(0.5, 1.2), draw(-0.6, -0.2));
            let half = [draw(0.05, 0.3), draw(0.05, 0.3)];
            let slabs = [[x - half[0], x + half[0]], [y - half[1], y + half[1]], [top - draw(0.05, 0.3), top]];
            let places = slabs.map(|slab| slab.map(|at| at as f32));
            let rays: [[f64; 3]; LANES] = std::array::from_fn(|lane| {
                let mut end = slabs.map(|[low, high]| draw(low - 0.02, high + 0.02));
                let axis = lane % 3;
                end[axis] = slabs[axis][usize::from(draw(0.0, 1.0) > 0.5)] + draw(-0.03, 0.03);
                end
            });
            let lane = |of: &dyn Fn(f64) -> f64| {
                std::array::from_fn(|axis| f32x4::new(std::array::from_fn(|k| of(rays[k][axis]) as f32)))
            };
            let lanes = Lanes { rays: lane(&|along| along), inverses: lane(&|along| 1.0 / along) };
            let says = Slabs { places }.meet(&lanes, f32x4::splat(TOLERANCE as f32));
            for (says, ray) in says.into_iter().zip(rays) {
                let Some(expected) = one_by_one(&slabs, ray) else { continue };
                assert_eq!(says, expected as u32, "{slabs:?} {ray:?}");
                kinds[says as usize] += 1;
                cases += 1;
            }
        }
        assert!(cases > 11_000, "{cases}");
        // Outer and inner faces of all walls that the eye can see, and everything else that a ray may say.
        assert!(kinds.iter().filter(|count| **count > 20).count() >= 12, "{kinds:?}");
        let blank = Lanes { rays: [f32x4::splat(f32::NAN); 3], inverses: [f32x4::splat(f32::NAN); 3] };
        let slabs = Slabs { places: [[-0.1, 0.1], [0.5, 0.7], [-0.5, -0.3]] };
        assert_eq!(slabs.meet(&blank, f32x4::splat(0.004)), [NOTHING as u32; LANES]);
    }
}
