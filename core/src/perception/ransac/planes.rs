//! Planar segments of one cluster: sequential RANSAC over sites, then every reading to its nearest plane.

use super::super::readings::Readings;
use super::super::segment::Segment;
use super::super::PerceptionSettings;
use super::components::{components, NONE};
use super::crease::fold;
use super::draws::PlaneSearch;
use super::sites::Sites;
use crate::geometry::{Moments, Plane};

/// Sites of one cluster, at most.
const MAX_CLUSTER_SITES: usize = 40_000;
/// Cells are at least as large as that a cell that is hit holds about this many readings.
const READINGS_PER_SITE: f64 = 5.0;
/// Cell sizes, metres, that are tried, smallest first.
const SITE_SIZES_M: [f64; 6] = [0.008, 0.011, 0.015, 0.02, 0.028, 0.04];
/// Rounds of "each reading to its nearest plane, each plane through its readings".
const ROUNDS: usize = 3;
/// Times that folded segments are looked for: a strip of four panels takes two.
const FOLD_PASSES: usize = 2;
/// Share of a cell's readings that makes a plane its owner.
const OWNER_SHARE: f64 = 0.3;

/// Planar segments of a cluster, in the order in which they were found.
pub fn planar_segments(readings: &Readings, cluster: &[u32], settings: &PerceptionSettings, seed: u64) -> Vec<Segment> {
    let sites = cluster_sites(readings, cluster);
    let search = PlaneSearch {
        sites: &sites,
        settings,
        reach_m: settings.ransac_reach_m,
        worth: (0..sites.len()).map(|s| sites.count(s)).collect(),
        min_worth: settings.min_segment_points as f64,
        max_planes: settings.max_planes_per_cluster,
        seed,
    };
    let found = search.run();
    let mut planes: Vec<Plane> = found.iter().map(|f| f.plane).collect();
    let mut owner = vec![NONE; sites.len()];
    for (k, plane) in found.iter().enumerate() {
        plane.sites.iter().for_each(|&s| owner[s as usize] = k as u32);
    }
    let mut segments = settle(readings, &sites, &mut planes, &mut owner);
    for _ in 0..FOLD_PASSES {
        if fold_all(readings, &sites, &segments, &mut planes, &mut owner, settings) {
            segments = settle(readings, &sites, &mut planes, &mut owner);
        }
    }
    segments.retain(|s| is_segment(readings, s, settings));
    segments
}

/// Readings to planes and planes to readings, a few times over.
fn settle(readings: &Readings, sites: &Sites, planes: &mut [Plane], owner: &mut [u32]) -> Vec<Segment> {
    let mut segments = Vec::new();
    for _ in 0..ROUNDS {
        segments = assign(readings, sites, planes, owner);
        segments.iter().zip(planes.iter_mut()).for_each(|(s, p)| *p = s.plane);
    }
    segments
}

/// Replaces the plane of each folded segment by two; whether there was one.
fn fold_all(
    readings: &Readings,
    sites: &Sites,
    segments: &[Segment],
    planes: &mut Vec<Plane>,
    owner: &mut [u32],
    settings: &PerceptionSettings,
) -> bool {
    let before = planes.len();
    for (k, segment) in segments.iter().enumerate() {
        let Some([one, other]) = fold(readings, segment, settings) else { continue };
        let new = planes.len() as u32;
        let nearer = |s: usize| {
            other.height_of(&sites.surfels.centers[s]).abs() < one.height_of(&sites.surfels.centers[s]).abs()
        };
        for (site, owner) in owner.iter_mut().enumerate().filter(|(_, o)| **o == k as u32) {
            if nearer(site) {
                *owner = new;
            }
        }
        planes[k] = one;
        planes.push(other);
    }
    planes.len() > before
}

/// Cells fine enough for small panels, coarse enough for several readings each.
fn cluster_sites(readings: &Readings, cluster: &[u32]) -> Sites {
    for size in SITE_SIZES_M {
        let sites = Sites::new(readings, cluster, size, MAX_CLUSTER_SITES);
        if cluster.len() as f64 >= READINGS_PER_SITE * sites.len() as f64 {
            return sites;
        }
    }
    Sites::new(readings, cluster, SITE_SIZES_M[SITE_SIZES_M.len() - 1], MAX_CLUSTER_SITES)
}

/// Gives each reading to the nearest plane of its cell and the cells around, keeps each plane's largest piece, refits.
fn assign(readings: &Readings, sites: &Sites, planes: &[Plane], owner: &mut [u32]) -> Vec<Segment> {
    let mut points: Vec<Vec<(u32, u32)>> = vec![Vec::new(); planes.len()];
    let mut nearby = Vec::new();
    for site in 0..sites.len() {
        planes_around(sites, owner, site, &mut nearby);
        for &i in sites.voxels.members_of(site) {
            if let Some(k) = nearest_plane(readings, planes, &nearby, i) {
                points[k as usize].push((i, site as u32));
            }
        }
    }
    owner.fill(NONE);
    let pieces = points.iter().map(|mine| largest_piece(sites, mine));
    let kept: Vec<Vec<(u32, u32)>> = pieces.collect();
    let gather = |(k, mine): (usize, &Vec<(u32, u32)>)| {
        claim_cells(sites, mine, k as u32, owner);
        segment_of(readings, sites, &planes[k], mine)
    };
    kept.iter().enumerate().map(gather).collect()
}

fn segment_of(readings: &Readings, sites: &Sites, before: &Plane, mine: &[(u32, u32)]) -> Segment {
    let mut moments = Moments::default();
    mine.iter().for_each(|&(i, _)| moments.add_point(&readings.point(i)));
    let (plane, rms_m) = moments.fit_plane().unwrap_or((*before, f64::INFINITY));
    let cells = mine.chunk_by(|a, b| a.1 == b.1).count() as f64;
    let mut points: Vec<u32> = mine.iter().map(|&(i, _)| i).collect();
    points.sort_unstable();
    Segment { plane, rms_m, area_m2: cells * sites.voxels.size_m.powi(2), points }
}

/// A plane owns the cells of which it has a fair share.
fn claim_cells(sites: &Sites, mine: &[(u32, u32)], plane: u32, owner: &mut [u32]) {
    for cell in mine.chunk_by(|a, b| a.1 == b.1) {
        let site = cell[0].1 as usize;
        if cell.len() as f64 >= OWNER_SHARE * sites.count(site) {
            owner[site] = plane;
        }
    }
}

fn planes_around(sites: &Sites, owner: &[u32], site: usize, nearby: &mut Vec<u32>) {
    nearby.clear();
    let around = sites.surfels.neighbours.of(site).iter().map(|&n| owner[n as usize]);
    nearby.extend(around.chain([owner[site]]).filter(|&o| o != NONE));
    nearby.sort_unstable();
    nearby.dedup();
}

fn nearest_plane(readings: &Readings, planes: &[Plane], nearby: &[u32], index: u32) -> Option<u32> {
    let p = readings.point(index);
    let mut best = (readings.tolerance_m(&p), None);
    for &k in nearby {
        let distance = planes[k as usize].height_of(&p).abs();
        if distance <= best.0 {
            best = (distance, Some(k));
        }
    }
    best.1
}

/// The Euclidean filter: the readings whose cells hang together, the largest such piece.
fn largest_piece(sites: &Sites, mine: &[(u32, u32)]) -> Vec<(u32, u32)> {
    let mut count = vec![0u32; sites.len()];
    mine.iter().for_each(|&(_, s)| count[s as usize] += 1);
    let (component, pieces) = components(&sites.surfels.neighbours, |s| count[s] > 0);
    let mut size = vec![0u32; pieces];
    for (s, &c) in component.iter().enumerate().filter(|(_, &c)| c != NONE) {
        size[c as usize] += count[s];
    }
    let best = (0..pieces).fold(0, |best, c| if size[c] > size[best] { c } else { best });
    mine.iter().copied().filter(|&(_, s)| component[s as usize] as usize == best).collect()
}

/// Enough readings, enough area, and flat (eq. 30).
fn is_segment(readings: &Readings, segment: &Segment, settings: &PerceptionSettings) -> bool {
    if segment.points.len() < settings.min_segment_points.max(3) {
        return false;
    }
    let middle = readings.point(segment.points[segment.points.len() / 2]);
    segment.area_m2 >= settings.min_segment_area_m2
        && segment.rms_m <= settings.max_rms_share * readings.tolerance_m(&middle)
}
