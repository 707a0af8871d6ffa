//! The errors of a structured-light camera of the first Kinect's kind, made in disparity, where they arise.
//!
//! Sources: Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data", Sensors 12 (2012): depth noise grows with z^2,
//! 1/8 px steps; Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise", 3DIMPVT (2012): losses at grazing angles; f and baseline as OpenNI reports them.

use crate::camera::Kinect;
use crate::cast::{cast, Hit};
use crate::field::Field;
use crate::random::{normal, uniform, Stream};
use crate::shade::{shade, Rgb};
use crate::{Scene, SensorError};
use rayon::prelude::*;

/// One pixel of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Optical frame, metres; NaN where there is no reading.
    pub point: [f32; 3],
    /// Surface that was measured; 0 for none and for flying pixels.
    pub surface_id: i32,
    pub rgb: Rgb,
}

/// What the camera reports, row by row. Same scene and seed, same bits, on any number of threads.
///
/// # Errors
/// [`SensorError`] for a scene or camera that does not fit.
pub fn simulate(scene: &Scene<'_>, camera: &Kinect, seed: u64) -> Result<Vec<Reading>, SensorError> {
    scene.check()?;
    camera.check()?;
    let hits = cast(scene, camera, Some(seed));
    let noise = Noise::new(seed);
    let blank = Reading { point: [f32::NAN; 3], surface_id: 0, rgb: [0; 3] };
    let mut readings = vec![blank; hits.len()];
    readings.par_chunks_mut(camera.width).enumerate().for_each(|(v, row)| {
        for (u, slot) in row.iter_mut().enumerate() {
            *slot = read_pixel(scene, camera, &noise, &hits, u, v);
        }
    });
    Ok(readings)
}

/// A depth edge is a step of more than this share of the disparity between neighbours.
const EDGE_SHARE: f64 = 0.03;

/// Sizes of the patches (the matcher's window is 7 to 9 px wide) and of the ripples.
const PATCH_PX: f64 = 5.0;
const RIPPLE_PX: f64 = 80.0;

struct Noise {
    seed: u64,
    patches: Field,
    ripples: Field,
    losses: Field,
}

impl Noise {
    fn new(seed: u64) -> Self {
        Self {
            seed,
            patches: Field::new(seed, Stream::Patch, PATCH_PX),
            ripples: Field::new(seed, Stream::Ripple, RIPPLE_PX),
            losses: Field::new(seed, Stream::GrazingPatch, PATCH_PX),
        }
    }

    fn disparity_px(&self, camera: &Kinect, u: usize, v: usize) -> f64 {
        let pixel = (v * camera.width + u) as u64;
        camera.white_px * normal(self.seed, Stream::WhiteRadius, Stream::WhiteAngle, pixel)
            + camera.patchy_px * self.patches.at(u, v)
            + camera.ripple_px * self.ripples.at(u, v)
    }
}

/// The disparity that the matcher finds in a pixel, before noise, and the surface it is of.
struct Match {
    disparity_px: f64,
    surface_id: i32,
}

fn read_pixel(scene: &Scene<'_>, camera: &Kinect, noise: &Noise, hits: &[Option<Hit>], u: usize, v: usize) -> Reading {
    let own = hits[v * camera.width + u];
    let rgb = shade(scene, camera, own, u, v);
    let found = own.and_then(|_| find_match(scene, camera, noise, hits, u, v));
    let measured = found.and_then(|m| Some((measure(camera, noise, &m, u, v)?, m.surface_id)));
    match measured {
        Some((depth_m, surface_id)) => Reading { point: to_point(camera, u, v, depth_m), surface_id, rgb },
        None => Reading { point: [f32::NAN; 3], surface_id: 0, rgb },
    }
}

fn find_match(
    scene: &Scene<'_>,
    camera: &Kinect,
    noise: &Noise,
    hits: &[Option<Hit>],
    u: usize,
    v: usize,
) -> Option<Match> {
    let pixel = v * camera.width + u;
    let own = hits[pixel]?;
    let neighbour = edge_neighbour(camera, noise, hits, u, v);
    let draw = uniform(noise.seed, Stream::Flying, pixel as u64);
    if let Some(other) = neighbour {
        if draw < camera.flying_share && own.lit {
            let share = 0.15 + 0.7 * uniform(noise.seed, Stream::FlyingMix, pixel as u64);
            let (a, b) = (camera.disparity_px(own.depth_m), camera.disparity_px(other.depth_m));
            return Some(Match { disparity_px: a + share * (b - a), surface_id: 0 });
        }
    }
    let taken = match neighbour {
        Some(other) if draw > 1.0 - camera.edge_swap_share => other,
        _ => own,
    };
    let is_lost = !taken.lit || is_grazing_loss(camera, noise, taken, u, v);
    let surface_id = scene.surface_ids[taken.triangle];
    (!is_lost).then(|| Match { disparity_px: camera.disparity_px(taken.depth_m), surface_id })
}

/// A pixel one step away on a random side, if a depth edge lies between it and this one.
fn edge_neighbour(camera: &Kinect, noise: &Noise, hits: &[Option<Hit>], u: usize, v: usize) -> Option<Hit> {
    let pixel = v * camera.width + u;
    let step = |stream| (uniform(noise.seed, stream, pixel as u64) * 3.0) as isize - 1;
    let (x, y) = (u as isize + step(Stream::EdgeU), v as isize + step(Stream::EdgeV));
    if x < 0 || y < 0 || x >= camera.width as isize || y >= camera.height as isize {
        return None;
    }
    let (own, other) = (hits[pixel]?, hits[y as usize * camera.width + x as usize]?);
    let (a, b) = (camera.disparity_px(own.depth_m), camera.disparity_px(other.depth_m));
    ((a - b).abs() > EDGE_SHARE * a.max(b)).then_some(other)
}

/// Losses grow with the angle of incidence and come in patches, as speckle that is too stretched to match.
fn is_grazing_loss(camera: &Kinect, noise: &Noise, hit: Hit, u: usize, v: usize) -> bool {
    let incidence_deg = hit.cos_incidence.clamp(0.0, 1.0).acos().to_degrees();
    let share = ((incidence_deg - camera.grazing_from_deg) / (camera.grazing_all_deg - camera.grazing_from_deg))
        .clamp(0.0, 1.0);
    if share <= 0.0 {
        return false;
    }
    let chance = (share * share + 0.15 * noise.losses.at(u, v) * share).clamp(0.0, 1.0);
    uniform(noise.seed, Stream::Grazing, (v * camera.width + u) as u64) < chance
}

/// Noise, then steps, then range: the reported depth, if any.
fn measure(camera: &Kinect, noise: &Noise, found: &Match, u: usize, v: usize) -> Option<f64> {
    let noisy = found.disparity_px + noise.disparity_px(camera, u, v);
    let stepped = (noisy / camera.disparity_step_px).round() * camera.disparity_step_px;
    let depth_m = camera.fx * camera.baseline_m / stepped;
    (camera.min_depth_m..=camera.max_depth_m).contains(&depth_m).then_some(depth_m)
}

fn to_point(camera: &Kinect, u: usize, v: usize, depth_m: f64) -> [f32; 3] {
    let x = (u as f64 - camera.cx) / camera.fx * depth_m;
    let y = (v as f64 - camera.cy) / camera.fy * depth_m;
    [x as f32, y as f32, depth_m as f32]
}
