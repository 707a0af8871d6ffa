//! A plain picture beside the depth: Lambert's law under a lamp at the camera and a lamp above it.

use crate::camera::Kinect;
use crate::cast::Hit;
use crate::vector::{cross, dot, norm, sub};
use crate::Scene;

/// Red, green, blue.
pub type Rgb = [u8; 3];

const BACKGROUND: Rgb = [60, 60, 64];
/// Towards the second lamp, in the camera's frame: up, left and back.
const LAMP: [f64; 3] = [-0.36, -0.80, -0.48];

pub(crate) fn shade(scene: &Scene<'_>, camera: &Kinect, hit: Option<Hit>, u: usize, v: usize) -> Rgb {
    let Some(hit) = hit else { return BACKGROUND };
    let [a, b, c] = scene.triangles[hit.triangle];
    let normal = cross(sub(b, a), sub(c, a));
    let ray = [(u as f64 - camera.cx) / camera.fx, (v as f64 - camera.cy) / camera.fy, 1.0];
    // The side of the triangle that is seen.
    let sign = -dot(normal, ray).signum();
    let lamp = (sign * dot(normal, LAMP) / norm(normal)).max(0.0);
    let light = 0.30 + 0.35 * hit.cos_incidence + 0.35 * lamp;
    scene.colors[hit.triangle].map(|c| (f64::from(c) * light).round().clamp(0.0, 255.0) as u8)
}
