//! Which surfaces belong to one thing.

use super::super::ransac::components::UnionFind;
use super::super::PerceptionSettings;
use super::pairs::Pairs;
use super::surfaces::Surfaces;
use super::things::Role;
use super::voxels::{Voxels, NONE};
use crate::geometry::{convex_hull, hull_contains, Plane, PlaneFrame, Point2, Vec3};

/// Pairs of voxels in which two surfaces touch, at least.
const MIN_TOUCHES: u32 = 3;
/// Voxels touch where their middles are no farther apart than this many sides ...
const TOUCH_SIDES: f64 = 1.7;
/// ... or, with a voxel of nobody's between them, this many.
const ACROSS_SIDES: f64 = 2.3;
/// Of one outline's corners and centre, the share inside the other's from which two things are one ...
const MIN_OVERLAP_SHARE: f64 = 0.1;
/// ... where this share of the lower one's height is beside the other.
const MIN_BESIDE_SHARE: f64 = 0.5;

/// What is seen of a set of surfaces from above, and between which heights it is.
struct Outline {
    hull: Vec<Point2>,
    low_m: f64,
    high_m: f64,
}

/// The thing that each surface belongs to, named by its first surface; surfaces of the background stay alone.
pub fn groups(
    surfaces: &Surfaces,
    voxels: &Voxels,
    roles: &[Role],
    up: &Vec3,
    settings: &PerceptionSettings,
) -> Vec<usize> {
    let mut sets = UnionFind::new(surfaces.list.len());
    for (a, b) in touching(surfaces, voxels, roles, settings.cluster_gap_m) {
        sets.join(a, b);
    }
    join_overlapping(surfaces, voxels, roles, up, settings, &mut sets);
    (0..surfaces.list.len()).map(|s| sets.find(s)).collect()
}

fn touching(surfaces: &Surfaces, voxels: &Voxels, roles: &[Role], gap_m: f64) -> Vec<(usize, usize)> {
    let is_thing = |o: u32| o != NONE && roles[o as usize] == Role::Thing;
    let gap_sq = |a: u32, b: u32| (voxels.centers[a as usize] - voxels.centers[b as usize]).norm_squared();
    let direct_sq = (TOUCH_SIDES * voxels.size_m).min(gap_m.max(voxels.size_m)).powi(2);
    let across_sq = (ACROSS_SIDES * voxels.size_m).min(gap_m.max(voxels.size_m)).powi(2);
    let mut touches: Pairs<u32> = Pairs::new();
    let mut around: Vec<(u32, u32)> = Vec::new();
    for v in 0..voxels.len() as u32 {
        let own = surfaces.owner[v as usize];
        let of_things = voxels.neighbours.of(v as usize).iter().map(|&n| (surfaces.owner[n as usize], n));
        let of_things = of_things.filter(|&(o, _)| is_thing(o));
        if is_thing(own) {
            let near = of_things.filter(|&(o, n)| o > own && gap_sq(v, n) < direct_sq);
            near.for_each(|(o, _)| *touches.of(own, o) += 1);
        } else if own == NONE {
            around.clear();
            around.extend(of_things);
            around.sort_unstable();
            for (k, a) in around.iter().enumerate() {
                let near = around[k + 1..].iter().filter(|b| b.0 != a.0 && gap_sq(a.1, b.1) < across_sq);
                near.for_each(|b| *touches.of(a.0, b.0) += 1);
            }
        }
    }
    let enough = touches.sorted().into_iter().filter(|&(_, count)| count >= MIN_TOUCHES);
    enough.map(|((a, b), _)| (a as usize, b as usize)).collect()
}

/// The near wall of a box and its far wall can be a box's length apart: things whose outlines overlap are one, unless one
/// hangs over the other.
fn join_overlapping(
    surfaces: &Surfaces,
    voxels: &Voxels,
    roles: &[Role],
    up: &Vec3,
    settings: &PerceptionSettings,
    sets: &mut UnionFind,
) {
    let frame = PlaneFrame::new(&Plane { normal: *up, distance: 0.0 }, &Vec3::zeros());
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); surfaces.list.len()];
    for s in (0..roles.len()).filter(|&s| roles[s] == Role::Thing) {
        members[sets.find(s)].extend(&surfaces.list[s].voxels);
    }
    let named: Vec<usize> = (0..members.len()).filter(|&m| !members[m].is_empty()).collect();
    let outlines: Vec<Outline> = named.iter().map(|&m| Outline::new(&members[m], voxels, &frame)).collect();
    let is_small = |o: &Outline| extent(&o.hull) <= settings.largest_thing_m;
    for a in (0..named.len()).filter(|&a| is_small(&outlines[a])) {
        for b in (0..a).filter(|&b| is_small(&outlines[b])) {
            if outlines[a].is_beside(&outlines[b]) && outlines[a].overlaps(&outlines[b]) {
                sets.join(named[a], named[b]);
            }
        }
    }
}

impl Outline {
    fn new(members: &[u32], voxels: &Voxels, frame: &PlaneFrame) -> Self {
        let places = members.iter().map(|&v| &voxels.centers[v as usize]);
        let flat: Vec<Point2> = places.clone().map(|c| frame.to_plane(c)).collect();
        let heights = places.map(|c| frame.normal.dot(c));
        let (low_m, high_m) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        Self { hull: convex_hull(&flat), low_m, high_m }
    }

    fn is_beside(&self, other: &Self) -> bool {
        let shared_m = self.high_m.min(other.high_m) - self.low_m.max(other.low_m);
        shared_m >= MIN_BESIDE_SHARE * (self.high_m - self.low_m).min(other.high_m - other.low_m)
    }

    fn overlaps(&self, other: &Self) -> bool {
        let share = |inner: &[Point2], outer: &[Point2]| {
            let n = inner.len() as f64;
            let center = inner.iter().fold([0.0; 2], |c, p| [c[0] + p[0] / n, c[1] + p[1] / n]);
            let inside = inner.iter().chain([&center]).filter(|p| hull_contains(outer, p, 0.0)).count();
            inside as f64 / (n + 1.0)
        };
        share(&self.hull, &other.hull) >= MIN_OVERLAP_SHARE || share(&other.hull, &self.hull) >= MIN_OVERLAP_SHARE
    }
}

/// Diagonal of the axis-parallel bounds, metres.
fn extent(hull: &[Point2]) -> f64 {
    let spread = |k: usize| {
        let along = hull.iter().map(|p| p[k]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    spread(0).hypot(spread(1))
}
