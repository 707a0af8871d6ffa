//! Exact depth: one ray for each pixel against the scene.

use crate::bvh::{Bvh, Ray};
use crate::kinect::Kinect;
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

/// With a seed, each ray is moved by up to `ray_jitter_px` within its pixel.
pub(crate) fn cast(scene: &Scene<'_>, camera: &Kinect, jitter_seed: Option<u64>) -> Vec<Option<Hit>> {
    let bvh = Bvh::new(scene.triangles);
    let pixels = camera.width * camera.height;
    let mut hits = vec![None; pixels];
    hits.par_chunks_mut(camera.width).enumerate().for_each(|(v, row)| {
        for (u, slot) in row.iter_mut().enumerate() {
            *slot = hit(scene, camera, &bvh, pixel_direction(camera, u, v, jitter_seed));
        }
    });
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

fn hit(scene: &Scene<'_>, camera: &Kinect, bvh: &Bvh, direction: Vec3) -> Option<Hit> {
    // The direction has z = 1, so the position along the ray is the depth.
    let (depth_m, triangle) = bvh.closest(&Ray::new([0.0; 3], direction))?;
    let [a, b, c] = scene.triangles[triangle];
    let normal = cross(sub(b, a), sub(c, a));
    let cos_incidence = (dot(normal, direction) / (norm(normal) * norm(direction))).abs();
    let point = direction.map(|d| d * depth_m);
    Some(Hit { depth_m, triangle, cos_incidence, lit: is_lit(camera, bvh, point) })
}

/// The projector stands `baseline_m` to the left of the camera; a point it does not see has no reading.
fn is_lit(camera: &Kinect, bvh: &Bvh, point: Vec3) -> bool {
    let projector = [-camera.baseline_m, 0.0, 0.0];
    let ray = Ray::new(projector, sub(point, projector));
    // Short of the point itself by a part that covers rounding.
    !bvh.blocked(&ray, 1.0 - 1e-4)
}
