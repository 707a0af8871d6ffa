//! Euclidean clusters of what stands above the support.

use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::components::{components, UnionFind, NONE};
use super::footing::extent;
use super::support::Ground;
use super::voxels::Voxels;
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2, Vec3};

/// Cells of the clustering, at most.
const MAX_CLUSTER_CELLS: usize = 400_000;
/// Of one outline's corners and centre, the share inside the other's from which two clusters are one thing.
const MIN_OVERLAP_SHARE: f64 = 0.1;

/// Readings above the support and off the walls of the room.
pub fn readings_of_things(
    readings: &Readings,
    indices: &[u32],
    ground: &Ground,
    settings: &PerceptionSettings,
) -> Vec<u32> {
    let off = |plane: &Plane, p: &Vec3| plane.height_of(p).abs() > readings.tolerance_m(p);
    let is_thing = |p: &Vec3| {
        let stands = ground.support.is_none_or(|support| {
            let height = support.height_of(p);
            height > readings.tolerance_m(p) && height < settings.tallest_thing_m
        });
        stands && ground.room.iter().all(|wall| off(wall, p))
    };
    indices.iter().copied().filter(|&i| is_thing(&readings.point(i))).collect()
}

/// Groups of readings, the largest first; within a group in input order.
///
/// Readings in the same or adjacent cells belong together; so do clusters whose outlines on the support overlap (the near
/// wall of a box, seen from outside, and its far wall, seen from inside, can be a box's length apart).
pub fn clusters(readings: &Readings, things: &[u32], ground: &Ground, settings: &PerceptionSettings) -> Vec<Vec<u32>> {
    if things.is_empty() {
        return vec![];
    }
    let voxels = Voxels::new(readings, things, cell_size_m(readings, things, settings), MAX_CLUSTER_CELLS);
    let (component, count) = components(&voxels.neighbours(), |_| true);
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); count];
    for (cell, &c) in component.iter().enumerate().filter(|(_, &c)| c != NONE) {
        members[c as usize].extend(voxels.members_of(cell));
    }
    members.retain(|m| m.len() >= settings.min_cluster_points);
    let mut groups = merge_overlapping(readings, members, ground, settings);
    groups.iter_mut().for_each(|g| g.sort_unstable());
    groups.sort_by(|a, b| b.len().cmp(&a.len()).then(a[0].cmp(&b[0])));
    groups
}

/// Cells as large as the gap that is bridged: at least the noise of the middle reading allows for.
fn cell_size_m(readings: &Readings, things: &[u32], settings: &PerceptionSettings) -> f64 {
    let sample = things.iter().step_by(1 + things.len() / 4096);
    let mut sigmas: Vec<f64> = sample.map(|&i| readings.sigma_m(&readings.point(i))).collect();
    sigmas.sort_unstable_by(f64::total_cmp);
    settings.cluster_gap_m.max(2.5 * sigmas[sigmas.len() / 2])
}

fn merge_overlapping(
    readings: &Readings,
    members: Vec<Vec<u32>>,
    ground: &Ground,
    settings: &PerceptionSettings,
) -> Vec<Vec<u32>> {
    let frame = PlaneFrame::new(&Plane { normal: ground.up, distance: 0.0 }, &Vec3::zeros());
    let outlines: Vec<Vec<Point2>> = members.iter().map(|m| outline(readings, m, &frame)).collect();
    let is_thing: Vec<bool> = outlines.iter().map(|o| extent(o) <= settings.largest_thing_m).collect();
    let mut sets = UnionFind::new(members.len());
    for a in 0..members.len() {
        for b in 0..a {
            if is_thing[a] && is_thing[b] && overlap(&outlines[a], &outlines[b]) {
                sets.join(a, b);
            }
        }
    }
    let mut merged: Vec<Vec<u32>> = vec![Vec::new(); members.len()];
    for (k, m) in members.into_iter().enumerate() {
        merged[sets.find(k)].extend(m);
    }
    merged.retain(|m| !m.is_empty());
    merged
}

fn outline(readings: &Readings, members: &[u32], frame: &PlaneFrame) -> Vec<Point2> {
    let footprint: Vec<Point2> = members.iter().map(|&i| frame.to_plane(&readings.point(i))).collect();
    convex_hull(&footprint)
}

/// Whether enough of either outline lies inside the other.
pub fn overlap(a: &[Point2], b: &[Point2]) -> bool {
    let share = |inner: &[Point2], outer: &[Point2]| {
        let n = inner.len() as f64;
        let center = inner.iter().fold([0.0; 2], |c, p| [c[0] + p[0] / n, c[1] + p[1] / n]);
        let inside = inner.iter().chain([&center]).filter(|p| hull_contains(outer, p, 0.0)).count();
        inside as f64 / (n + 1.0)
    };
    share(a, b) >= MIN_OVERLAP_SHARE || share(b, a) >= MIN_OVERLAP_SHARE
}
