//! Bases lie on the support, within its tolerance: what the walls of a group enclose is a piece of its own.

use super::piece::{keep, Piece};
use super::rays::Rays;
use super::runs::{Run, Runs};
use super::things::Sorting;
use crate::geometry::{Plane, PlaneFrame, Point2, Vec3};
use crate::perception::ransac::enclosure::Enclosure;
use crate::perception::ransac::parting::Walls;
use crate::perception::scene::BACKGROUND;

/// Parts of the support that meet in fewer columns of neighbouring rows are apart: a wall seen from above parts them.
const MIN_BRIDGE_PX: u32 = 3;
/// Upright pieces without which nothing is enclosed.
const MIN_WALLS: usize = 2;
/// One pixel in so many stands for the others in footprints of walls, and as many of a patch are looked at.
const STRIDE_PX: usize = 3;
const STRIDE_ROWS: usize = 2;
const PATCH_SAMPLE: usize = 256;
/// A part that no wall was seen around fills this share of its hull, and that of its rectangle, and is this wide.
const MIN_FILL: f64 = 0.5;
const MIN_BASE_M: f64 = 0.05;
/// Its group comes this near to it, seen from above.
const MAX_GAP_M: f64 = 0.05;

/// Adds the bases that groups enclose; the support and level pieces on it lose them. `pitch` is between the rays of
/// neighbouring pixels.
pub fn add_bases(rays: &Rays, pitch: f64, sorting: &Sorting, pieces: &mut Vec<Piece>, group: &mut Vec<i32>) {
    let (Some(plane), Some(support)) = (sorting.ground.support, sorting.support) else { return };
    let mut patches = parts(rays, &pieces[support], support, sorting.settings.min_segment_points);
    let is_low = |p: usize| {
        let in_band = |piece| sorting.mean_height(piece, &plane, |_| 1.0).abs() < sorting.settings.base_band_m;
        p != support && group[p] == BACKGROUND && in_band(&pieces[p])
    };
    let low = (0..pieces.len()).filter(|&p| is_low(p));
    patches.extend(low.map(|p| Patch { runs: pieces[p].runs.clone(), of: p }));
    if patches.is_empty() {
        return;
    }
    let floor = Floor { sorting, support: &plane, frame: PlaneFrame::new(&plane, &pieces[support].hull[0]) };
    let mut lost: Vec<Vec<Run>> = vec![Vec::new(); pieces.len()];
    let mut bases = Vec::new();
    for g in 0..group.iter().max().map_or(0, |&g| g + 1) {
        let of_group: Vec<&Piece> =
            pieces.iter().zip(group.iter()).filter(|(_, &of)| of == g).map(|(p, _)| p).collect();
        for runs in floor.enclosed(&of_group, &mut patches, &mut lost) {
            bases.extend(Piece::from_runs(rays, runs).map(|base| (base, g)));
        }
    }
    for patch in patches.into_iter().filter(|p| p.of == support) {
        let Some(base) = Piece::from_runs(rays, patch.runs.clone()) else { continue };
        if let Some(g) = floor.owner_of_hole(rays, &base, pitch, pieces, group) {
            lost[support].extend(patch.runs);
            bases.push((base, g));
        }
    }
    let mut emptied = vec![false; pieces.len()];
    for (p, lost) in lost.iter().enumerate().filter(|(_, l)| !l.is_empty()) {
        match pieces[p].without(rays, lost) {
            Some(rest) => pieces[p] = rest,
            None => emptied[p] = true,
        }
    }
    keep(pieces, group, |p| !emptied[p]);
    for (base, g) in bases {
        pieces.push(base);
        group.push(g);
    }
}

/// What may be a base: pixels of the piece `of`.
struct Patch {
    runs: Vec<Run>,
    of: usize,
}

/// The parts of the support that are connected, but for the largest and for strays.
fn parts(rays: &Rays, piece: &Piece, of: usize, min_points: usize) -> Vec<Patch> {
    let runs = Runs::of_one(piece.runs.clone(), rays.width, rays.height);
    let component = runs.components(MIN_BRIDGE_PX);
    let mut parts: Vec<(usize, Vec<Run>)> = vec![(0, Vec::new()); runs.runs.len()];
    for (run, &c) in runs.runs.iter().zip(&component) {
        parts[c as usize].0 += run.len() as usize;
    }
    let largest = (0..parts.len()).fold(0, |best, k| if parts[k].0 > parts[best].0 { k } else { best });
    for (run, &c) in runs.runs.iter().zip(&component) {
        if c as usize != largest && parts[c as usize].0 >= min_points {
            parts[c as usize].1.push(*run);
        }
    }
    let parts = parts.into_iter().filter(|(_, runs)| !runs.is_empty());
    parts.map(|(_, runs)| Patch { runs, of }).collect()
}

/// The support as a map.
struct Floor<'a> {
    sorting: &'a Sorting<'a>,
    support: &'a Plane,
    frame: PlaneFrame,
}

impl Floor<'_> {
    /// Takes the patches that a group encloses: the runs of one base for those that no wall parts.
    fn enclosed(&self, of_group: &[&Piece], patches: &mut Vec<Patch>, lost: &mut [Vec<Run>]) -> Vec<Vec<Run>> {
        let walls: Vec<&&Piece> = of_group.iter().filter(|p| self.is_wall(p)).collect();
        if walls.len() < MIN_WALLS {
            return vec![];
        }
        let band_m = self.sorting.settings.base_band_m;
        let standing = of_group
            .iter()
            .flat_map(|p| p.runs.iter().step_by(STRIDE_ROWS).flat_map(|r| (r.start..r.end).step_by(STRIDE_PX)));
        let standing = standing.map(|i| self.sorting.readings.point(i)).filter(|p| self.support.height_of(p) > band_m);
        let standing: Vec<Point2> = standing.map(|p| self.frame.to_plane(&p)).collect();
        let Some(enclosure) = Enclosure::new(&standing, self.sorting.settings.base_margin_m) else { return vec![] };
        let mut mine: Vec<Vec<Run>> = Vec::new();
        patches.retain_mut(|patch| {
            let inside = enclosure.encloses(&self.flat(&patch.runs));
            if inside {
                lost[patch.of].extend(&patch.runs);
                mine.push(std::mem::take(&mut patch.runs));
            }
            !inside
        });
        let walls = Walls::new(walls.iter().map(|p| self.flat(&p.runs)));
        let middles: Vec<Vec<Point2>> = mine.iter().map(|runs| self.flat(runs)).collect();
        walls
            .join_unparted(&middles)
            .into_iter()
            .map(|members| {
                let mut runs: Vec<Run> = members.iter().flat_map(|&k| mine[k].iter().copied()).collect();
                runs.sort_unstable_by_key(|r| r.start);
                runs
            })
            .collect()
    }

    /// The group that a part of the support belongs to which no wall was seen around: a box seen from straight above
    /// shows its walls as lines without readings. Such a part fills its rectangle and lies amid the image.
    fn owner_of_hole(&self, rays: &Rays, part: &Piece, pitch: f64, pieces: &[Piece], group: &[i32]) -> Option<i32> {
        let (width, height) = (rays.width as u32, rays.height as u32);
        let at_border = |r: &Run| {
            let row = r.start / width;
            row == 0 || row + 1 == height || r.start.is_multiple_of(width) || r.end.is_multiple_of(width)
        };
        let hull: Vec<Point2> = part.hull.iter().map(|c| self.frame.to_plane(c)).collect();
        let fills = polygon_area(&hull) > MIN_FILL * part.rectangle.area()
            && part.area_m2(pitch) > MIN_FILL * polygon_area(&hull);
        let narrow = part.rectangle.size().iter().any(|&side| side < MIN_BASE_M);
        if part.runs.iter().any(at_border) || !fills || narrow {
            return None;
        }
        let near = pieces.iter().zip(group).filter(|(_, &g)| g != BACKGROUND).filter_map(|(piece, &g)| {
            let gap_m = |c: &Vec3| gap_m(&hull, &self.frame.to_plane(c));
            piece.hull.iter().map(gap_m).min_by(f64::total_cmp).map(|gap_m| (gap_m, g))
        });
        near.filter(|n| n.0 < MAX_GAP_M).min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))).map(|n| n.1)
    }

    fn is_wall(&self, piece: &Piece) -> bool {
        piece.plane.normal.dot(&self.support.normal).abs() < self.sorting.settings.wall_tilt_rad.sin()
    }

    fn flat(&self, runs: &[Run]) -> Vec<Point2> {
        let points: usize = runs.iter().map(|r| r.len() as usize).sum();
        let pixels = runs.iter().flat_map(|r| r.start..r.end).step_by(1 + points / PATCH_SAMPLE);
        pixels.map(|i| self.frame.to_plane(&self.sorting.readings.point(i))).collect()
    }
}

/// By the shoelace formula, whichever way round.
fn polygon_area(hull: &[Point2]) -> f64 {
    let next = |k: usize| hull[(k + 1) % hull.len()];
    (0..hull.len()).map(|k| hull[k][0] * next(k)[1] - hull[k][1] * next(k)[0]).sum::<f64>().abs() / 2.0
}

/// From a point to a polygon's nearest edge.
fn gap_m(hull: &[Point2], p: &Point2) -> f64 {
    let distance = |k: usize| {
        let (a, b) = (hull[k], hull[(k + 1) % hull.len()]);
        let (x, y) = (b[0] - a[0], b[1] - a[1]);
        let t = (((p[0] - a[0]) * x + (p[1] - a[1]) * y) / (x * x + y * y).max(1e-12)).clamp(0.0, 1.0);
        (p[0] - a[0] - t * x).hypot(p[1] - a[1] - t * y)
    };
    (0..hull.len()).map(distance).fold(f64::INFINITY, f64::min)
}
