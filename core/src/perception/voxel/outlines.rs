//! Hulls from the few readings that can be their corners.

use super::fixed_fit::FixedFit;
use super::labels::Labels;
use super::surfaces::Surfaces;
use super::voxels::{Voxels, NONE};
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2};

/// Directions in which a surface's farthest voxels are looked for.
const DIRECTIONS: usize = 16;
/// Half of a cube's longest diagonal, in sides.
const HALF_DIAGONAL: f64 = 0.867;

/// A surface's final plane (inside) and the corners of its readings' hull in it.
pub struct Outline {
    pub plane: Plane,
    pub rms_m: f64,
    pub frame: PlaneFrame,
    pub hull: Vec<Point2>,
}

/// The outline of each surface; `None` where its readings span no plane.
///
/// The middles of voxels that are wholly a surface's lie within the hull of its readings, so no reading well inside a
/// polygon of such middles is a corner (Akl and Toussaint 1978).
pub fn outlines(
    points: &[[f32; 3]],
    voxel_of: &[u32],
    voxels: &Voxels,
    surfaces: &Surfaces,
    labels: &Labels,
) -> Vec<Option<Outline>> {
    let mut all: Vec<Option<Outline>> = labels.fits.iter().map(Outline::of_fit).collect();
    let is_inner = inner_voxels(voxels, surfaces, labels, &all);
    let mut outer: Vec<Vec<Point2>> = vec![Vec::new(); all.len()];
    for ((p, &voxel), &label) in points.iter().zip(voxel_of).zip(&labels.of_reading) {
        if label == NONE || (is_inner[voxel as usize] && surfaces.owner[voxel as usize] == label) {
            continue;
        }
        if let Some(outline) = &all[label as usize] {
            outer[label as usize].push(outline.frame.to_plane(&voxels.inside(p)));
        }
    }
    for (outline, outer) in all.iter_mut().zip(&outer) {
        if let Some(o) = outline {
            o.hull = convex_hull(outer);
        }
    }
    all
}

impl Outline {
    fn of_fit(fit: &FixedFit) -> Option<Self> {
        let (moments, about) = fit.moments();
        let (local, rms_m) = moments.fit_plane()?;
        let plane = Plane { normal: local.normal, distance: local.distance + local.normal.dot(&about) };
        Some(Self { plane, rms_m, frame: PlaneFrame::new(&plane, &about), hull: vec![] })
    }
}

/// Of each voxel, whether it lies too far inside its owner to hold a corner of the hull.
fn inner_voxels(voxels: &Voxels, surfaces: &Surfaces, labels: &Labels, all: &[Option<Outline>]) -> Vec<bool> {
    let mut is_inner = vec![false; voxels.len()];
    for (surface, outline) in surfaces.list.iter().zip(all) {
        let Some(outline) = outline else { continue };
        let middles: Vec<Point2> =
            surface.voxels.iter().map(|&v| outline.frame.to_plane(&voxels.centers[v as usize])).collect();
        let whole = surface.voxels.iter().zip(&middles).filter(|(&v, _)| labels.is_whole[v as usize]);
        let polygon = farthest(whole.map(|(_, m)| *m));
        // A voxel's middle is anywhere in its cube.
        let margin_m = 2.0 * HALF_DIAGONAL * voxels.size_m;
        for (&v, middle) in surface.voxels.iter().zip(&middles) {
            is_inner[v as usize] = hull_contains(&polygon, middle, margin_m);
        }
    }
    is_inner
}

/// The polygon of the farthest places in some directions.
fn farthest(places: impl Iterator<Item = Point2>) -> Vec<Point2> {
    let directions: [Point2; DIRECTIONS] = std::array::from_fn(|k| {
        let (s, c) = (std::f64::consts::TAU * k as f64 / DIRECTIONS as f64).sin_cos();
        [c, s]
    });
    let mut most = [(f64::NEG_INFINITY, [0.0; 2]); DIRECTIONS];
    for p in places {
        for (best, d) in most.iter_mut().zip(&directions) {
            let along = p[0] * d[0] + p[1] * d[1];
            if along > best.0 {
                *best = (along, p);
            }
        }
    }
    let corners: Vec<Point2> = most.iter().filter(|m| m.0.is_finite()).map(|m| m.1).collect();
    convex_hull(&corners)
}
