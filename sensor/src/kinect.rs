//! The errors of a structured-light camera of the first Kinect's kind, made in disparity, where they arise.
//!
//! Sources: Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data", Sensors 12 (2012): depth noise grows with z^2,
//! 1/8 px steps; Nguyen, Izadi, Lovell, "Modeling Kinect Sensor Noise", 3DIMPVT (2012): losses at grazing angles; f and baseline as OpenNI reports them.

use crate::cast::{cast, Hit};
use crate::field::Field;
use crate::random::{normal, uniform, Stream};
use crate::shade::{shade, Rgb};
use crate::{Scene, SensorError};
use rayon::prelude::*;

/// Camera and error model; the defaults are a Kinect at VGA.
#[derive(Clone, Debug)]
pub struct Kinect {
    pub width: usize,
    pub height: usize,
    pub fx: f64,
    pub fy: f64,
    pub cx: f64,
    pub cy: f64,
    /// From the camera to the projector on its left, metres.
    pub baseline_m: f64,
    pub min_depth_m: f64,
    pub max_depth_m: f64,
    pub disparity_step_px: f64,
    /// Standard deviations of the disparity's noise, pixels: for each pixel alone, in patches, in slow ripples.
    pub white_px: f64,
    pub patchy_px: f64,
    pub ripple_px: f64,
    /// Half the width of a ray's random place in its pixel.
    pub ray_jitter_px: f64,
    /// Share of the readings beside a depth edge that mix both sides, and of those that take a neighbour's.
    pub flying_share: f64,
    pub edge_swap_share: f64,
    /// Readings begin to be lost at the first angle of incidence and are all lost at the second, degrees.
    pub grazing_from_deg: f64,
    pub grazing_all_deg: f64,
}

impl Default for Kinect {
    fn default() -> Self {
        Self {
            width: 640,
            height: 480,
            fx: 575.8,
            fy: 575.8,
            cx: 319.5,
            cy: 239.5,
            baseline_m: 0.075,
            min_depth_m: 0.45,
            max_depth_m: 4.5,
            disparity_step_px: 0.125,
            white_px: 0.045,
            patchy_px: 0.055,
            ripple_px: 0.030,
            ray_jitter_px: 0.5,
            flying_share: 0.12,
            edge_swap_share: 0.35,
            grazing_from_deg: 72.0,
            grazing_all_deg: 89.0,
        }
    }
}

impl Kinect {
    /// # Errors
    /// [`SensorError`] naming the parameter that cannot be.
    pub fn check(&self) -> Result<(), SensorError> {
        let positive = [
            ("fx", self.fx),
            ("fy", self.fy),
            ("baseline_m", self.baseline_m),
            ("disparity_step_px", self.disparity_step_px),
        ];
        if let Some((name, value)) = positive.into_iter().find(|(_, v)| !(*v > 0.0 && v.is_finite())) {
            return Err(SensorError::new(format!("{name} is {value}: expected a positive number")));
        }
        let (w, h) = (self.width, self.height);
        if w == 0 || h == 0 || w > 1 << 14 || h > 1 << 14 {
            return Err(SensorError::new(format!("image of {w} x {h} pixels: expected 1 to 16384 each way")));
        }
        if !(0.0 < self.min_depth_m && self.min_depth_m < self.max_depth_m) {
            return Err(SensorError::new(format!(
                "range {} to {} m: expected 0 < min < max",
                self.min_depth_m, self.max_depth_m
            )));
        }
        if self.grazing_from_deg.partial_cmp(&self.grazing_all_deg) != Some(std::cmp::Ordering::Less) {
            return Err(SensorError::new("grazing_from_deg must lie below grazing_all_deg"));
        }
        Ok(())
    }

    fn disparity_px(&self, depth_m: f64) -> f64 {
        self.fx * self.baseline_m / depth_m
    }
}

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
