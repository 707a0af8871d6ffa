//! Exact depth: one ray for each pixel against the scene.

use crate::bvh::{Bvh, Candidates, Ray};
use crate::camera::Kinect;
use crate::frustum::Frustum;
use crate::random::{uniform, Stream};
use crate::vector::{cross, dot, norm, sub, Vec3};
use crate::{Scene, SensorError};
use rayon::prelude::*;

/// What a pixel's ray met first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Depth along the optical axis, metres.
    pub depth_m: f64,
    pub triangle: usize,
    /// |cosine| of the angle between ray and surface normal: 1 face on, 0 grazing.
    pub cos_incidence: f64,
    /// Seen by the projector too.
    pub lit: bool,
}

/// Exact readings at the pixels' centres, row by row; nothing where the ray meets nothing.
///
/// # Errors
/// [`SensorError`] for a scene or camera that does not fit.
pub fn cast_exact(scene: &Scene<'_>, camera: &Kinect) -> Result<Vec<Option<Hit>>, SensorError> {
    scene.check()?;
    camera.check()?;
    Ok(cast(scene, camera, None))
}

/// Pixels each way of a tile, whose rays share a list of triangles.
const TILE: usize = 8;

/// With a seed, each ray is moved by up to `ray_jitter_px` within its pixel.
pub(crate) fn cast(scene: &Scene<'_>, camera: &Kinect, jitter_seed: Option<u64>) -> Vec<Option<Hit>> {
    let bvh = Bvh::new(scene.triangles);
    let mut hits = vec![None; camera.width * camera.height];
    hits.par_chunks_mut(camera.width * TILE).enumerate().for_each(|(band, rows)| {
        for first in (0..camera.width).step_by(TILE) {
            let us = first..(first + TILE).min(camera.width);
            let height = rows.len() / camera.width;
            let pixels: Vec<_> = (0..height).flat_map(|v| us.clone().map(move |u| (u, band * TILE + v))).collect();
            for (&(u, v), hit) in pixels.iter().zip(cast_tile(scene, camera, &bvh, &pixels, jitter_seed)) {
                rows[(v - band * TILE) * camera.width + u] = hit;
            }
        }
    });
    hits
}

/// Pixels (u, v) that lie near each other.
fn cast_tile(
    scene: &Scene<'_>,
    camera: &Kinect,
    bvh: &Bvh,
    pixels: &[(usize, usize)],
    jitter_seed: Option<u64>,
) -> Vec<Option<Hit>> {
    let directions: Vec<Vec3> = pixels.iter().map(|&(u, v)| pixel_direction(camera, u, v, jitter_seed)).collect();
    let mut hits = vec![None; pixels.len()];
    if let Some(bundle) = Frustum::around([0.0; 3], directions.iter().copied()) {
        let seen = bvh.gather(&bundle.endless());
        hits = directions.iter().map(|&direction| hit(scene, bvh, &seen, direction)).collect();
    }
    light(camera, bvh, &directions, &mut hits);
    hits
}

fn pixel_direction(camera: &Kinect, u: usize, v: usize, jitter_seed: Option<u64>) -> Vec3 {
    let pixel = (v * camera.width + u) as u64;
    let shift =
        |stream| jitter_seed.map_or(0.0, |seed| 2.0 * camera.ray_jitter_px * (uniform(seed, stream, pixel) - 0.5));
    let x = (u as f64 + shift(Stream::JitterU) - camera.cx) / camera.fx;
    let y = (v as f64 + shift(Stream::JitterV) - camera.cy) / camera.fy;
    [x, y, 1.0]
}

fn hit(scene: &Scene<'_>, bvh: &Bvh, seen: &Candidates, direction: Vec3) -> Option<Hit> {
    // The direction has z = 1, so the position along the ray is the depth.
    let (depth_m, triangle) = bvh.closest(seen, &Ray::new([0.0; 3], direction))?;
    let [a, b, c] = scene.triangles[triangle];
    let normal = cross(sub(b, a), sub(c, a));
    let cos_incidence = (dot(normal, direction) / (norm(normal) * norm(direction))).abs();
    Some(Hit { depth_m, triangle, cos_incidence, lit: false })
}

/// The projector stands `baseline_m` to the left of the camera; a point that it does not see has no reading.
fn light(camera: &Kinect, bvh: &Bvh, directions: &[Vec3], hits: &mut [Option<Hit>]) {
    let projector = [-camera.baseline_m, 0.0, 0.0];
    let point = |direction: Vec3, hit: &Hit| direction.map(|d| d * hit.depth_m);
    let points = directions.iter().zip(hits.iter()).filter_map(|(&d, h)| h.as_ref().map(|h| point(d, h)));
    let Some(bundle) = Frustum::around(projector, points) else { return };
    let between = bvh.gather(&bundle);
    for (&direction, hit) in directions.iter().zip(hits) {
        if let Some(hit) = hit {
            let ray = Ray::new(projector, sub(point(direction, hit), projector));
            // Short of the point itself by a part that covers rounding.
            hit.lit = !bvh.blocked(&between, &ray, 1.0 - 1e-4);
        }
    }
}
