//! The base of an open box lies within the support's tolerance: only what the walls enclose tells the two apart.

use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::PerceptionSettings;
use super::enclosure::Enclosure;
use super::parting::Walls;
use crate::geometry::{convex_hull, Moments, Plane, PlaneFrame, Point2};

/// Upright segments without which nothing is enclosed.
const MIN_WALLS: usize = 2;
/// Side of a patch of an unorganized cloud's band, metres.
const PATCH_M: f64 = 0.012;
/// Connected pixels below this number are strays.
const MIN_PATCH_POINTS: usize = 12;

/// Readings at the support's height, in patches that hang together, gathered once for all groups.
pub struct SupportBand {
    support: Plane,
    frame: PlaneFrame,
    patches: Vec<Vec<u32>>,
}

impl SupportBand {
    /// `free` says of each point of the cloud that it is a reading of no segment; `width` is 0 for an unorganized cloud.
    pub fn new(
        readings: &Readings,
        free: &[bool],
        width: usize,
        support: &Plane,
        settings: &PerceptionSettings,
    ) -> Self {
        let in_band = |i: usize| {
            let p = readings.point(i as u32);
            free[i] && support.height_of(&p).abs() <= settings.base_band_m.max(readings.tolerance_m(&p))
        };
        let band: Vec<bool> = (0..free.len()).map(in_band).collect();
        let origin = band.iter().position(|&b| b).map_or_else(Default::default, |i| readings.point(i as u32));
        let frame = PlaneFrame::new(support, &origin);
        let patches = if width > 0 { pixel_patches(&band, width) } else { square_patches(readings, &band, &frame) };
        Self { support: *support, frame, patches }
    }

    /// Adds to a group's segments the patches that it encloses, one base for those that no wall parts; level segments that
    /// lie in the band are taken into them.
    pub fn add_base(&self, readings: &Readings, segments: &mut Vec<Segment>, settings: &PerceptionSettings) {
        if segments.iter().filter(|s| self.is_wall(s, settings)).count() < MIN_WALLS {
            return;
        }
        let outline = self.standing_points(readings, segments, settings);
        let Some(enclosure) = Enclosure::new(&outline, settings.base_margin_m) else { return };
        let flat = |points: &[u32]| points.iter().map(|&i| self.frame.to_plane(&readings.point(i))).collect::<Vec<_>>();
        let encloses = |patch: &&Vec<u32>| enclosure.encloses(&flat(patch));
        let is_base =
            |s: &Segment| self.is_level_in_band(readings, s, settings) && enclosure.encloses(&flat(&s.points));
        let mut patches: Vec<Vec<u32>> = self.patches.iter().filter(encloses).cloned().collect();
        patches.extend(segments.iter().filter(|s| is_base(s)).map(|s| s.points.clone()));
        let walls = Walls::new(segments.iter().filter(|s| self.is_wall(s, settings)).map(|s| flat(&s.points)));
        let footprints: Vec<Vec<Point2>> = patches.iter().map(|p| flat(p)).collect();
        let joined = walls.join_unparted(&footprints).into_iter().map(|members| {
            let mut points: Vec<u32> = members.iter().flat_map(|&k| patches[k].iter().copied()).collect();
            points.sort_unstable();
            points
        });
        let bases = joined.filter_map(|points| self.segment_of(readings, points));
        let is_enough =
            |s: &Segment| s.points.len() >= settings.min_segment_points && s.area_m2 >= settings.min_segment_area_m2;
        let bases: Vec<Segment> = bases.filter(is_enough).collect();
        segments.retain(|s| !is_base(s));
        segments.extend(bases);
    }

    fn segment_of(&self, readings: &Readings, points: Vec<u32>) -> Option<Segment> {
        let mut moments = Moments::default();
        points.iter().for_each(|&i| moments.add_point(&readings.point(i)));
        let (plane, rms_m) = moments.fit_plane()?;
        let footprint: Vec<Point2> = points.iter().map(|&i| self.frame.to_plane(&readings.point(i))).collect();
        Some(Segment { plane, rms_m, area_m2: polygon_area(&convex_hull(&footprint)), points })
    }

    /// Footprint of the group's readings above the band, without what lies level in it.
    fn standing_points(&self, readings: &Readings, segments: &[Segment], settings: &PerceptionSettings) -> Vec<Point2> {
        let standing = segments.iter().filter(|s| !self.is_level_in_band(readings, s, settings));
        let points = standing.flat_map(|s| &s.points).map(|&i| readings.point(i));
        points.filter(|p| self.support.height_of(p) > settings.base_band_m).map(|p| self.frame.to_plane(&p)).collect()
    }

    fn is_wall(&self, segment: &Segment, settings: &PerceptionSettings) -> bool {
        segment.plane.normal.dot(&self.support.normal).abs() < settings.wall_tilt_rad.sin()
    }

    fn is_level_in_band(&self, readings: &Readings, segment: &Segment, settings: &PerceptionSettings) -> bool {
        let heights_m = segment.points.iter().map(|&i| self.support.height_of(&readings.point(i)));
        let height_m = heights_m.sum::<f64>() / segment.points.len() as f64;
        let level = segment.plane.normal.dot(&self.support.normal).abs() > settings.wall_tilt_rad.cos();
        level && height_m.abs() < settings.base_band_m
    }
}

/// Connected pixels (by their sides) of the band: a base and the floor outside never touch in the image.
fn pixel_patches(band: &[bool], width: usize) -> Vec<Vec<u32>> {
    let mut seen = vec![false; band.len()];
    let mut patches = Vec::new();
    for start in (0..band.len()).filter(|&i| band[i]) {
        if seen[start] {
            continue;
        }
        seen[start] = true;
        let mut patch = vec![start as u32];
        let mut next = 0;
        while next < patch.len() {
            let i = patch[next] as usize;
            let (left, right) = (!i.is_multiple_of(width), i % width + 1 < width);
            let around =
                [(left, i.wrapping_sub(1)), (right, i + 1), (i >= width, i.wrapping_sub(width)), (true, i + width)];
            for (_, j) in around.into_iter().filter(|&(inside, j)| inside && j < band.len()) {
                if band[j] && !seen[j] {
                    seen[j] = true;
                    patch.push(j as u32);
                }
            }
            next += 1;
        }
        if patch.len() >= MIN_PATCH_POINTS {
            patches.push(patch);
        }
    }
    patches
}

/// Squares of the band, in order of their place.
fn square_patches(readings: &Readings, band: &[bool], frame: &PlaneFrame) -> Vec<Vec<u32>> {
    let square = |i: usize| {
        let [a, b] = frame.to_plane(&readings.point(i as u32));
        ((a / PATCH_M).floor() as i64, (b / PATCH_M).floor() as i64, i as u32)
    };
    let mut placed: Vec<_> = (0..band.len()).filter(|&i| band[i]).map(square).collect();
    placed.sort_unstable();
    let squares = placed.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1));
    squares.map(|s| s.iter().map(|&(_, _, i)| i).collect()).collect()
}

fn polygon_area(hull: &[Point2]) -> f64 {
    let cross = |k: usize| {
        let (a, b) = (hull[k], hull[(k + 1) % hull.len()]);
        a[0] * b[1] - a[1] * b[0]
    };
    (0..hull.len()).map(cross).sum::<f64>().abs() / 2.0
}
