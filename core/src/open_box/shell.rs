//! A box without flaps, held against the depth image: each ray meets an outer face, or goes in by the opening and meets a wall's
//! inner face or the base.

use std::ops::Range;

use super::proposal::Proposal;
use super::sight::Sight;
use super::silhouette::Silhouette;
use crate::geometry::Vec3;

/// What the rays say of a box's four walls, in pixels of the image; walls as in `Proposal`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct ShellLook {
    /// Readings on outer faces and on inner ones.
    pub met: [[f64; 2]; 4],
    pub through: f64,
    pub hidden: f64,
    /// Readings that close the opening, and those below it.
    pub lid: f64,
    pub inside: f64,
}

/// Every so many pixels of a row, and rows, are asked.
const STRIDE: usize = 8;
/// Proposals are off by this much beside the noise, metres.
const MODEL_M: f64 = 0.009;
/// What lies this near to the rim's plane, and over the opening, closes it.
const LID_M: f64 = 0.006;

/// Flaps that are shut close a part of an opening: so much of it for each reading below.
const INSIDE_TO_LID: f64 = 0.6;

impl ShellLook {
    /// What speaks for the box. What hides it says little: of two boxes that are seen alike the smaller.
    pub fn score(&self) -> f64 {
        self.met.iter().flatten().sum::<f64>()
            - 2.0 * self.through
            - (self.lid - INSIDE_TO_LID * self.inside).max(0.0)
            - 0.05 * self.hidden
    }

    /// The score if so much more were on its walls, and below its opening.
    fn most(&self, left_over: f64) -> f64 {
        Self { inside: self.inside + left_over, ..*self }.score() + left_over
    }
}

/// Every so many readings of the image, as seen from the eye; directions are not of unit length: they end in the reading.
pub struct Rays {
    to_reading: Vec<Vec3>,
    tolerance: Vec<f64>,
    columns: usize,
    rows: usize,
}

/// The rays, and the eye, along the directions that many boxes share.
pub struct RaysAlong {
    eye: [f64; 3],
    /// With their inverses.
    rays: Vec<([f64; 3], [f64; 3])>,
}

impl Rays {
    pub fn new(sight: &Sight) -> Self {
        let (columns, rows) = (sight.width.div_ceil(STRIDE), sight.height.div_ceil(STRIDE));
        let place = |k: usize| {
            let (x, y) = (
                (k % columns * STRIDE + STRIDE / 2).min(sight.width - 1),
                (k / columns * STRIDE + STRIDE / 2).min(sight.height - 1),
            );
            sight.reading(y * sight.width + x).map_or(Vec3::repeat(f64::NAN), |p| p - sight.eye)
        };
        let to_reading: Vec<Vec3> = (0..columns * rows).map(place).collect();
        // Per metre of range: cos and range come with the face.
        let tolerance = to_reading.iter().map(|d| 3.0 * sight.sigma_m(d.norm()) / d.norm()).collect();
        Self { to_reading, tolerance, columns, rows }
    }

    /// The rays along a box's directions.
    pub fn along(&self, sight: &Sight, proposal: &Proposal) -> RaysAlong {
        let axes = [proposal.axes[0], proposal.axes[1], proposal.up];
        let of = |v: &Vec3| axes.each_ref().map(|axis| v.dot(axis));
        let ray = |v: &Vec3| (of(v), of(v).map(|along| 1.0 / along));
        RaysAlong { eye: of(&sight.eye), rays: self.to_reading.iter().map(ray).collect() }
    }

    /// Looks at a box's shell; `turned` are the rays along its directions. `None` of one that cannot come to `least`.
    pub fn look(&self, sight: &Sight, proposal: &Proposal, turned: &RaysAlong, least: f64) -> Option<ShellLook> {
        let mut looked = ShellLook::default();
        let outline = outline(sight, proposal)?;
        let [_, _, top, bottom] = self.bounds(sight, &outline)?;
        let eye = turned.eye;
        let [x, y] = proposal.spans;
        let slabs = [x, y, proposal.heights];
        let pixels = (STRIDE * STRIDE) as f64;
        let rows: Vec<Range<usize>> = (top..=bottom).map(|row| self.columns(&outline, row)).collect();
        let mut left_over: usize = rows.iter().map(Range::len).sum();
        for (row, columns) in (top..=bottom).zip(rows) {
            if looked.most(left_over as f64 * pixels) < least {
                return None;
            }
            left_over -= columns.len();
            for column in columns {
                let k = row * self.columns + column;
                let (ray, inverse) = &turned.rays[k];
                if !ray[0].is_finite() {
                    continue;
                }
                let Some((face, at)) = meet(&eye, ray, inverse, &slabs) else { continue };
                if face.is_inner && (eye[2] + ray[2] - slabs[2][1]).abs() < LID_M + self.tolerance[k] * ray[2].abs() {
                    looked.lid += pixels;
                    continue;
                }
                if face.is_inner && eye[2] + ray[2] < slabs[2][1] {
                    looked.inside += pixels;
                }
                let reach = ray[face.axis].abs();
                let off = (1.0 - at) * reach;
                let tolerance = self.tolerance[k] * reach + MODEL_M;
                if off > tolerance {
                    looked.through += pixels;
                } else if off < -tolerance {
                    looked.hidden += pixels;
                } else if face.axis < 2 {
                    looked.met[2 * face.axis + usize::from(face.is_high)][usize::from(face.is_inner)] += pixels;
                }
            }
        }
        (looked.score() >= least).then_some(looked)
    }

    /// Pixels that meet the outside of a closed box less twice those that look through it; `None` where it is not in the image.
    pub fn look_at_closed(&self, sight: &Sight, proposal: &Proposal, turned: &RaysAlong) -> Option<f64> {
        let outline = outline(sight, proposal)?;
        let [_, _, top, bottom] = self.bounds(sight, &outline)?;
        let [x, y] = proposal.spans;
        let slabs = [x, y, proposal.heights];
        let mut score = 0.0;
        let of_row = |row: usize| self.columns(&outline, row).map(move |column| row * self.columns + column);
        for k in (top..=bottom).flat_map(of_row) {
            let (ray, inverse) = &turned.rays[k];
            if !ray[0].is_finite() {
                continue;
            }
            let Some((axis, at)) = enter(&turned.eye, inverse, &slabs) else { continue };
            let reach = ray[axis].abs();
            let off = (1.0 - at) * reach;
            let tolerance = self.tolerance[k] * reach + MODEL_M;
            if off.abs() <= tolerance {
                score += 1.0;
            } else if off > tolerance {
                score -= 2.0;
            }
        }
        Some(score * (STRIDE * STRIDE) as f64)
    }

    /// Of a row of the grid those that may meet the box.
    fn columns(&self, outline: &Silhouette, row: usize) -> Range<usize> {
        // The last column and row may be nearer.
        let half = (STRIDE / 2) as f64;
        let [low, high] = outline.columns((row * STRIDE) as f64 + half);
        let (low, high) = ((low - half) / STRIDE as f64, (high - half) / STRIDE as f64);
        low.ceil().clamp(0.0, self.columns as f64) as usize
            ..(high.floor() + 1.0).clamp(0.0, self.columns as f64) as usize
    }

    /// Of a box in the grid of rays: left, right, top, bottom, inclusive.
    fn bounds(&self, sight: &Sight, outline: &Silhouette) -> Option<[usize; 4]> {
        let bounds = outline.bounds();
        let cell = |at: f64, count: usize| (at / STRIDE as f64).floor().clamp(0.0, count as f64 - 1.0) as usize;
        let (width, height) = (sight.width as f64, sight.height as f64);
        let is_seen = bounds[1] >= 0.0 && bounds[0] < width && bounds[3] >= 0.0 && bounds[2] < height;
        is_seen.then(|| {
            [
                cell(bounds[0], self.columns),
                cell(bounds[1], self.columns),
                cell(bounds[2], self.rows),
                cell(bounds[3], self.rows),
            ]
        })
    }
}

/// Of the box in the image; `None` of one that reaches behind the camera.
fn outline(sight: &Sight, proposal: &Proposal) -> Option<Silhouette> {
    let mut corners = [[0.0; 2]; 8];
    for (number, corner) in corners.iter_mut().enumerate() {
        let pick = |a: usize| proposal.spans[a][number >> a & 1];
        let z = proposal.up * proposal.heights[number >> 2];
        *corner = sight.pixel(&(proposal.axes[0] * pick(0) + proposal.axes[1] * pick(1) + z))?;
    }
    Some(Silhouette::new(corners))
}

/// The axis of the face by which a ray enters a closed box, and where, the reading being at 1.
fn enter(eye: &[f64; 3], inverse: &[f64; 3], slabs: &[[f64; 2]; 3]) -> Option<(usize, f64)> {
    let (mut entry, mut exit) = ((0, f64::NEG_INFINITY), f64::INFINITY);
    for axis in 0..3 {
        let (a, b) = ((slabs[axis][0] - eye[axis]) * inverse[axis], (slabs[axis][1] - eye[axis]) * inverse[axis]);
        if a.min(b) > entry.1 {
            entry = (axis, a.min(b));
        }
        exit = exit.min(a.max(b));
    }
    (entry.1 < exit && entry.1 > 0.0).then_some(entry)
}

struct Face {
    axis: usize,
    is_high: bool,
    is_inner: bool,
}

/// The face that a ray meets of a box that is open at the top, and where, the reading being at 1.
fn meet(eye: &[f64; 3], ray: &[f64; 3], inverse: &[f64; 3], slabs: &[[f64; 2]; 3]) -> Option<(Face, f64)> {
    let (mut entry, mut exit) = ((f64::NEG_INFINITY, 0), (f64::INFINITY, 0));
    for axis in 0..3 {
        let (a, b) = ((slabs[axis][0] - eye[axis]) * inverse[axis], (slabs[axis][1] - eye[axis]) * inverse[axis]);
        let (near, far) = if a < b { (a, b) } else { (b, a) };
        if near > entry.0 {
            entry = (near, axis);
        }
        if far < exit.0 {
            exit = (far, axis);
        }
    }
    if entry.0 >= exit.0 || entry.0 <= 0.0 {
        return None;
    }
    if entry.1 == 2 {
        // By the opening, from above; from below nothing is seen of it.
        let face = Face { axis: exit.1, is_high: ray[exit.1] > 0.0, is_inner: true };
        return (ray[2] < 0.0).then_some((face, exit.0));
    }
    Some((Face { axis: entry.1, is_high: ray[entry.1] < 0.0, is_inner: false }, entry.0))
}
