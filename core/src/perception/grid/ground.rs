use super::noise::Noise;
use super::piece::Piece;
use super::regions::NONE;
use crate::error::Result;
use crate::geometry::{Plane, Vec3};
use crate::perception::ransac::draws::SitePlane;
use crate::perception::ransac::support::{ground_among, Ground, SeenPlanes};
use crate::perception::ransac::surfels::Surfels;
use crate::perception::ransac::voxels::Neighbours;
use crate::perception::readings::Readings;
use crate::perception::PerceptionSettings;

/// One reading in a square of this many pixels is looked at.
const STRIDE_PX: usize = 12;
/// Cells on the ground are as wide as most of the squares are apart there: this share of them, and this much wider.
const CELL_QUANTILE: f64 = 0.7;
const CELL_SLACK: f64 = 1.4;
/// Neighbouring squares belong to one surface within this many cells.
const TOUCHING_CELLS: f64 = 1.8;
/// Planes that may be the ground, the largest.
const MAX_CANDIDATES: usize = 6;
/// Their rectangles cover at least this.
const MIN_AREA_M2: f64 = 0.02;
/// Sine of the angle by which a patch may lean from a plane that it lies on.
const MAX_LEAN_SINE: f64 = 0.35;

/// What the pieces of an image are asked: whose each pixel is, and the pieces.
pub struct Seen<'a> {
    pub labels: &'a [u16],
    /// The piece of each label; `NONE` for no piece.
    pub piece_of_label: &'a [u16],
    pub width: usize,
    pub pieces: &'a [Piece],
}

impl Seen<'_> {
    fn piece(&self, pixel: u32) -> Option<usize> {
        let label = self.labels[pixel as usize];
        let piece = *self.piece_of_label.get(usize::from(label))?;
        (piece != NONE).then_some(usize::from(piece))
    }
}

/// Up, the support and the walls of the room, and the piece that is the support.
///
/// # Errors
/// `InputError` where several directions are plausible, or the support is seen from below.
pub fn find_ground(
    readings: &Readings,
    seen: &Seen,
    noise: &Noise,
    settings: &PerceptionSettings,
) -> Result<(Ground, Option<usize>)> {
    let mut candidates: Vec<usize> =
        (0..seen.pieces.len()).filter(|&p| seen.pieces[p].rectangle.area() > MIN_AREA_M2).collect();
    candidates.sort_by_key(|&p| std::cmp::Reverse(seen.pieces[p].points));
    candidates.truncate(MAX_CANDIDATES);
    let surfels = surfels(readings, seen, noise, settings);
    let is_large = |&p: &usize| seen.pieces[p].rectangle.size().iter().any(|&side| side > settings.largest_thing_m);
    let is_large: Vec<bool> = candidates.iter().map(is_large).collect();
    let on_plane = |plane: Plane| {
        let is_on = |&s: &usize| {
            plane.height_of(&surfels.centers[s]).abs() <= surfels.tolerance_m[s]
                && surfels.normals[s].cross(&plane.normal).norm() <= MAX_LEAN_SINE
        };
        SitePlane { plane, sites: (0..surfels.len()).filter(is_on).map(|s| s as u32).collect() }
    };
    let planes: Vec<SitePlane> = candidates.iter().map(|&p| on_plane(seen.pieces[p].plane)).collect();
    let among = SeenPlanes { surfels: &surfels, planes: &planes, is_large: &is_large };
    // The pieces' planes are least squares over all their readings: nothing to refit.
    let ground = ground_among(&among, |_, plane| *plane, readings.viewpoint.as_ref(), true, settings)?;
    let support = ground.chosen.map(|c| candidates[c]);
    Ok((ground, support))
}

/// One patch for each square of the image, neighbours where they touch in space.
fn surfels(readings: &Readings, seen: &Seen, noise: &Noise, settings: &PerceptionSettings) -> Surfels {
    let (squares, columns) = first_readings(readings, seen.width);
    let pixels: Vec<u32> = squares.iter().copied().flatten().collect();
    let centers: Vec<Vec3> = pixels.iter().map(|&i| readings.point(i)).collect();
    let mut spacings: Vec<f64> =
        centers.iter().map(|c| CELL_SLACK * STRIDE_PX as f64 * noise.pitch * readings.range_m(c)).collect();
    let place = (spacings.len() as f64 * CELL_QUANTILE) as usize;
    let spacing_m = if spacings.is_empty() { 0.0 } else { *spacings.select_nth_unstable_by(place, f64::total_cmp).1 };
    let cell_m = settings.scene_cell_m.max(spacing_m);
    let mut number = vec![u32::MAX; squares.len()];
    let seen_squares = squares.iter().enumerate().filter(|(_, s)| s.is_some());
    seen_squares.enumerate().for_each(|(k, (square, _))| number[square] = k as u32);
    let neighbours = {
        let lists = (0..squares.len()).filter(|&s| number[s] != u32::MAX).map(|square| {
            let own = centers[number[square] as usize];
            let (x, y, rows) = (square % columns, square / columns, squares.len() / columns);
            let around = (0..9).filter(|&k| k != 4).filter_map(move |k| {
                let (x, y) = ((x + k % 3).checked_sub(1)?, (y + k / 3).checked_sub(1)?);
                (x < columns && y < rows).then_some(y * columns + x)
            });
            let (number, centers) = (&number, &centers);
            around.filter_map(move |other| {
                let other = *number.get(other)?;
                let near = (centers.get(other as usize)? - own).norm() < TOUCHING_CELLS * cell_m;
                near.then_some(other)
            })
        });
        Neighbours::new(lists)
    };
    let tolerance_m = centers.iter().map(|c| readings.tolerance_m(c)).collect();
    let normals =
        pixels.iter().map(|&i| seen.piece(i).map_or(Vec3::zeros(), |p| seen.pieces[p].plane.normal)).collect();
    Surfels { cell_m, centers, tolerance_m, normals, neighbours }
}

/// The middle reading of each square of the image, or its first, row by row; and how many squares are in a row.
fn first_readings(readings: &Readings, width: usize) -> (Vec<Option<u32>>, usize) {
    let height = readings.points.len() / width;
    let columns = width.div_ceil(STRIDE_PX);
    let mut out = Vec::with_capacity(columns * height.div_ceil(STRIDE_PX));
    for y in (0..height).step_by(STRIDE_PX) {
        for x in (0..width).step_by(STRIDE_PX) {
            let (x_end, y_end) = ((x + STRIDE_PX).min(width), (y + STRIDE_PX).min(height));
            let middle = ((y + y_end) / 2 * width + (x + x_end) / 2) as u32;
            let all = (y..y_end).flat_map(|row| row * width + x..row * width + x_end).map(|i| i as u32);
            out.push(std::iter::once(middle).chain(all).find(|&i| readings.is_reading(i)));
        }
    }
    (out, columns)
}
