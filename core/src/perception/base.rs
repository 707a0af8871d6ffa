//! The base of an open box lies within the support's tolerance: only what the walls enclose tells the two apart.

use super::planes::Segment;
use super::readings::Readings;
use super::PerceptionSettings;
use crate::geometry::{convex_hull, hull_contains, Moments, Plane, PlaneFrame, Point2};

/// Walls that turn less than this against each other do not enclose: cosine of 45 degrees.
const PARALLEL_COSINE: f64 = 0.707;
/// Share of a wall's readings that may be lower than its foot (strays).
const FOOT_SHARE: f64 = 0.02;

/// Readings at the support's height, gathered once for all groups.
pub struct SupportBand {
    support: Plane,
    frame: PlaneFrame,
    indices: Vec<u32>,
}

impl SupportBand {
    pub fn new(readings: &Readings, indices: &[u32], support: &Plane, settings: &PerceptionSettings) -> Self {
        let near = |i: &u32| {
            let p = readings.point(*i);
            support.height_of(&p).abs() <= settings.base_band_m.max(readings.tolerance_m(&p))
        };
        let indices: Vec<u32> = indices.iter().copied().filter(near).collect();
        let origin = indices.first().map_or_else(Default::default, |&i| readings.point(i));
        Self { support: *support, frame: PlaneFrame::new(support, &origin), indices }
    }

    /// Adds to a group's segments the readings that its walls enclose; segments that lie in the band are taken into it.
    pub fn add_base(&self, readings: &Readings, segments: &mut Vec<Segment>, settings: &PerceptionSettings) {
        let Some(outline) = self.wall_outline(readings, segments, settings) else { return };
        let is_base = |s: &Segment| self.is_in_band(readings, s, &outline, settings);
        let mut points: Vec<u32> = segments.iter().filter(|s| is_base(s)).flat_map(|s| s.points.clone()).collect();
        let claimed = claimed(segments);
        let inside =
            |i: &u32| hull_contains(&outline, &self.frame.to_plane(&readings.point(*i)), settings.base_margin_m);
        points.extend(self.indices.iter().copied().filter(|i| claimed.binary_search(i).is_err() && inside(i)));
        points.sort_unstable();
        points.dedup();
        let mut moments = Moments::default();
        points.iter().for_each(|&i| moments.add_point(&readings.point(i)));
        let Some((plane, rms_m)) = moments.fit_plane() else { return };
        let footprint: Vec<Point2> = points.iter().map(|&i| self.frame.to_plane(&readings.point(i))).collect();
        let area_m2 = polygon_area(&convex_hull(&footprint));
        if points.len() >= settings.min_segment_points && area_m2 >= settings.min_segment_area_m2 {
            segments.retain(|s| !is_base(s));
            segments.push(Segment { plane, rms_m, area_m2, points });
        }
    }

    /// Outline on the support of the walls that reach down to it; `None` where they are too few to enclose anything.
    fn wall_outline(
        &self,
        readings: &Readings,
        segments: &[Segment],
        settings: &PerceptionSettings,
    ) -> Option<Vec<Point2>> {
        let walls: Vec<&Segment> = segments.iter().filter(|s| self.is_wall(readings, s, settings)).collect();
        let normals = walls.iter().map(|w| w.plane.normal);
        let crossing = normals.clone().any(|a| normals.clone().any(|b| a.dot(&b).abs() < PARALLEL_COSINE));
        let points = walls.iter().flat_map(|w| &w.points).map(|&i| self.frame.to_plane(&readings.point(i)));
        crossing.then(|| convex_hull(&points.collect::<Vec<_>>()))
    }

    fn is_wall(&self, readings: &Readings, segment: &Segment, settings: &PerceptionSettings) -> bool {
        let upright = segment.plane.normal.dot(&self.support.normal).abs() < settings.wall_tilt_rad.sin();
        upright && {
            let mut heights: Vec<f64> =
                segment.points.iter().map(|&i| self.support.height_of(&readings.point(i))).collect();
            let foot = (heights.len() as f64 * FOOT_SHARE) as usize;
            *heights.select_nth_unstable_by(foot, f64::total_cmp).1 < settings.wall_foot_m
        }
    }

    fn is_in_band(
        &self,
        readings: &Readings,
        segment: &Segment,
        outline: &[Point2],
        settings: &PerceptionSettings,
    ) -> bool {
        let center = mean(readings, segment);
        let level = segment.plane.normal.dot(&self.support.normal).abs() > settings.wall_tilt_rad.cos();
        level
            && self.support.height_of(&center).abs() < settings.base_band_m
            && hull_contains(outline, &self.frame.to_plane(&center), settings.base_margin_m)
    }
}

fn mean(readings: &Readings, segment: &Segment) -> crate::geometry::Vec3 {
    let mut moments = Moments::default();
    segment.points.iter().for_each(|&i| moments.add_point(&readings.point(i)));
    moments.mean()
}

/// Readings of all segments, sorted.
fn claimed(segments: &[Segment]) -> Vec<u32> {
    let mut all: Vec<u32> = segments.iter().flat_map(|s| s.points.iter().copied()).collect();
    all.sort_unstable();
    all
}

fn polygon_area(hull: &[Point2]) -> f64 {
    let cross = |k: usize| {
        let (a, b) = (hull[k], hull[(k + 1) % hull.len()]);
        a[0] * b[1] - a[1] * b[0]
    };
    (0..hull.len()).map(cross).sum::<f64>().abs() / 2.0
}
