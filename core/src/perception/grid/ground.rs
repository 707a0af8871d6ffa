use super::piece::Piece;
use super::regions::NONE;
use crate::error::Result;
use crate::geometry::{Plane, Vec3};
use crate::perception::ransac::scene_planes::{ScenePlanes, MAX_SCENE_SITES};
use crate::perception::ransac::sites::Sites;
use crate::perception::ransac::support::{ground_among, Ground};
use crate::perception::readings::Readings;
use crate::perception::PerceptionSettings;

/// One reading in a square of this many pixels is looked at.
const STRIDE_PX: usize = 8;
/// Planes that may be the ground, the largest.
const MAX_CANDIDATES: usize = 8;
/// Their rectangles cover at least this.
const MIN_AREA_M2: f64 = 0.02;

/// Up, the support and the walls of the room, among planes that were found; with the number of the piece that each
/// candidate is.
///
/// # Errors
/// `InputError` where several directions are plausible, or the support is seen from below.
pub fn find_ground(
    readings: &Readings,
    labels: &[u16],
    width: usize,
    pieces: &[Piece],
    planes: &[Plane],
    settings: &PerceptionSettings,
) -> Result<(Ground, Vec<usize>)> {
    let sample = sample(readings, width);
    let normal_of = |i: u32| match labels[i as usize] {
        NONE => Vec3::zeros(),
        label => planes[usize::from(label)].normal,
    };
    let sites = Sites::of_known_normals(readings, &sample, settings.scene_cell_m, MAX_SCENE_SITES, normal_of);
    let mut candidates: Vec<usize> = (0..pieces.len()).filter(|&p| pieces[p].rectangle.area() > MIN_AREA_M2).collect();
    candidates.sort_by_key(|&p| std::cmp::Reverse(pieces[p].points));
    candidates.truncate(MAX_CANDIDATES);
    let is_large = |p: usize| pieces[p].rectangle.size().iter().any(|&side| side > settings.largest_thing_m);
    let known: Vec<(Plane, bool)> = candidates.iter().map(|&p| (planes[p], is_large(p))).collect();
    let scene = ScenePlanes::of_known(sites, &known);
    Ok((ground_among(&scene, readings, true, settings)?, candidates))
}

/// The first reading in each square of the image.
fn sample(readings: &Readings, width: usize) -> Vec<u32> {
    let height = readings.points.len() / width;
    let mut out = Vec::with_capacity(width.div_ceil(STRIDE_PX) * height.div_ceil(STRIDE_PX));
    for y in (0..height).step_by(STRIDE_PX) {
        for x in (0..width).step_by(STRIDE_PX) {
            let square = (y..(y + STRIDE_PX).min(height))
                .flat_map(|row| row * width + x..row * width + (x + STRIDE_PX).min(width));
            out.extend(square.map(|i| i as u32).find(|&i| readings.is_reading(i)));
        }
    }
    out
}
