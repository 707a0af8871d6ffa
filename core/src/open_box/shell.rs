//! A box without flaps, held against the depth image: each ray meets an outer face, or goes in by the opening and meets a wall's
//! inner face or the base.

use std::ops::Range;

use super::proposal::Proposal;
use super::shell_look::ShellLook;
use super::sight::Sight;
use super::silhouette::Silhouette;
use super::slabs::{lanes_of, with_lanes, Counts, Lanes, Slabs, LANES, MODEL_M, PIXELS, STRIDE};
use crate::geometry::Vec3;

/// After so many rows it is asked whether a box can still come to enough.
const BETWEEN: usize = 4;

/// Every so many readings of the image, as seen from the eye; directions are not of unit length: they end in the reading.
pub struct Rays {
    to_reading: Vec<Vec3>,
    /// Followed by as many as are looked at together.
    tolerance: Vec<f32>,
    columns: usize,
    rows: usize,
}

/// The rays, and the eye, along the directions that many boxes share; axis by axis, with their inverses, each list followed by as many
/// as are looked at together. A ray without a reading is not a number.
pub struct RaysAlong {
    eye: [f32; 3],
    rays: [Vec<f32>; 3],
    inverses: [Vec<f32>; 3],
}

impl RaysAlong {
    fn lanes(&self, from: usize) -> Lanes {
        Lanes {
            rays: self.rays.each_ref().map(|of| lanes_of(of, from)),
            inverses: self.inverses.each_ref().map(|of| lanes_of(of, from)),
        }
    }
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
        let tolerance = with_lanes(to_reading.iter().map(|d| 3.0 * sight.sigma_m(d.norm()) / d.norm()));
        Self { to_reading, tolerance, columns, rows }
    }

    /// The rays along a box's directions.
    pub fn along(&self, sight: &Sight, proposal: &Proposal) -> RaysAlong {
        let axes = [proposal.axes[0], proposal.axes[1], proposal.up];
        let along = |axis: &Vec3| self.to_reading.iter().map(|v| v.dot(axis)).collect::<Vec<f64>>();
        let rays = axes.each_ref().map(along);
        RaysAlong {
            eye: axes.each_ref().map(|axis| sight.eye.dot(axis) as f32),
            inverses: rays.each_ref().map(|of| with_lanes(of.iter().map(|along| 1.0 / along))),
            rays: rays.each_ref().map(|of| with_lanes(of.iter().copied())),
        }
    }

    /// Looks at a box's shell; `turned` are the rays along its directions. `None` of one that cannot come to `least`.
    pub fn look(&self, sight: &Sight, proposal: &Proposal, turned: &RaysAlong, least: f64) -> Option<ShellLook> {
        let outline = outline(sight, proposal)?;
        let [_, _, top, bottom] = self.bounds(sight, &outline)?;
        let slabs = Slabs::new(proposal, &turned.eye);
        let rows: Vec<Range<usize>> = (top..=bottom).map(|row| self.columns(sight, &outline, row)).collect();
        let mut left_over: usize = rows.iter().map(Range::len).sum();
        let mut counts = Counts::default();
        for (row, columns) in (top..=bottom).zip(rows) {
            if row % BETWEEN == 0 && counts.looked().most(left_over as f64 * PIXELS) < least {
                return None;
            }
            left_over -= columns.len();
            for column in columns.clone().step_by(LANES) {
                let from = row * self.columns + column;
                let says = slabs.meet(&turned.lanes(from), lanes_of(&self.tolerance, from));
                says.iter().take(columns.end - column).for_each(|says| counts.add(*says));
            }
        }
        let looked = counts.looked();
        (looked.score() >= least).then_some(looked)
    }

    /// Pixels that meet the outside of a closed box less twice those that look through it; `None` where it is not in the image.
    pub fn look_at_closed(&self, sight: &Sight, proposal: &Proposal, turned: &RaysAlong) -> Option<f64> {
        let outline = outline(sight, proposal)?;
        let [_, _, top, bottom] = self.bounds(sight, &outline)?;
        let slabs = Slabs::new(proposal, &turned.eye);
        let mut score = 0.0;
        let of_row = |row: usize| self.columns(sight, &outline, row).map(move |column| row * self.columns + column);
        for k in (top..=bottom).flat_map(of_row) {
            let Some((axis, at)) = slabs.enter(turned.inverses.each_ref().map(|of| of[k])) else { continue };
            let reach = turned.rays[axis][k].abs();
            let off = (1.0 - at) * reach;
            let tolerance = self.tolerance[k] * reach + MODEL_M;
            if off.abs() <= tolerance {
                score += 1.0;
            } else if off > tolerance {
                score -= 2.0;
            }
        }
        Some(score * PIXELS)
    }

    /// Of a row of the grid those that may meet the box.
    fn columns(&self, sight: &Sight, outline: &Silhouette, row: usize) -> Range<usize> {
        let (half, pixels) = ((STRIDE / 2) as f64, STRIDE as f64);
        // The last row and column may be nearer to those before.
        let [low, high] = outline.columns((row as f64 * pixels + half).min(sight.height as f64 - 1.0));
        let end = if high < sight.width as f64 - 1.0 { (high - half) / pixels + 1.0 } else { self.columns as f64 };
        let cell = |at: f64| at.clamp(0.0, self.columns as f64) as usize;
        cell(((low - half) / pixels).ceil())..cell(end.floor())
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
    let [x, y] = &proposal.spans;
    Silhouette::of(|[i, j, k]| {
        let level = proposal.axes[0] * x[i] + proposal.axes[1] * y[j];
        sight.pixel(&(level + proposal.up * proposal.heights[k]))
    })
}
