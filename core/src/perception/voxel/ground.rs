use super::super::ransac::scene_planes::ScenePlanes;
use super::super::ransac::support::{ground_among, Ground, SeenPlanes};
use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::surfaces::{Surface, Surfaces};
use super::voxels::Voxels;
use crate::error::Result;
use crate::geometry::{Plane, Vec3};

/// Surfaces that may be the ground, at most: the largest.
const MAX_CANDIDATES: usize = 40;
/// Readings of a sample that tells the typical range.
const RANGE_SAMPLE: usize = 512;
/// Noise below this many times the expected is as expected.
const AS_EXPECTED: f64 = 1.5;
/// Most of a surface's voxels, where it is a piece of a plane ...
const MOST_VOXELS: f64 = 0.7;
/// ... from which it leans no more than 10 degrees: cosine.
const LEAN_COSINE: f64 = 0.985;

/// The middles of all voxels as 32-bit readings in the input's frame, by the voxels' order.
pub fn middles(voxels: &Voxels) -> Vec<[f32; 3]> {
    voxels.centers.iter().map(|c| (c + voxels.low).map(|x| x as f32).into()).collect()
}

/// Takes the readings to be as noisy as the voxels were found to be.
pub fn expect_noise(readings: &mut Readings, sigma_m: f64) {
    let sample = readings.points.iter().step_by(1 + readings.points.len() / RANGE_SAMPLE).copied();
    let mut expected: Vec<f64> = sample.map(|p| readings.sigma_m(&Vec3::from(p.map(f64::from)))).collect();
    let middle = expected.len() / 2;
    let (_, typical, _) = expected.select_nth_unstable_by(middle, f64::total_cmp);
    let scale = sigma_m / *typical;
    if scale > AS_EXPECTED {
        readings.scale_noise(scale);
    }
}

/// Which way is up, and on which of the surfaces' planes the things stand.
///
/// # Errors
/// `InputError` where several directions are plausible, or the support is seen from below.
pub fn find_ground(
    voxels: &Voxels,
    readings: &Readings,
    surfaces: &Surfaces,
    settings: &PerceptionSettings,
) -> Result<Ground> {
    let mut known: Vec<&Surface> = surfaces.list.iter().collect();
    known.sort_by_key(|s| std::cmp::Reverse(s.voxels.len()));
    let planes: Vec<_> = known.iter().take(MAX_CANDIDATES).map(|s| voxels.plane_of_input(&s.plane)).collect();
    let indices: Vec<u32> = (0..voxels.len() as u32).collect();
    let scene = ScenePlanes::of_planes(readings, &indices, &planes, settings);
    let seen = SeenPlanes { surfels: &scene.sites.surfels, planes: &scene.planes, is_large: &scene.is_large };
    let refit = |k: usize, plane: &Plane| scene.refit(readings, k, plane);
    ground_among(&seen, refit, readings.viewpoint.as_ref(), false, settings)
}

/// Whether a surface is a piece of the plane (told inside).
pub fn lies_in(surface: &Surface, voxels: &Voxels, plane: &Plane, tolerance_m: f64) -> bool {
    let is_near = |v: &&u32| plane.height_of(&voxels.centers[**v as usize]).abs() <= tolerance_m;
    surface.plane.normal.dot(&plane.normal).abs() > LEAN_COSINE
        && surface.voxels.iter().filter(is_near).count() as f64 >= MOST_VOXELS * surface.voxels.len() as f64
}
