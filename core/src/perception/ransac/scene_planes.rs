use super::super::readings::Readings;
use super::super::PerceptionSettings;
use super::draws::{PlaneSearch, SitePlane};
use super::sites::Sites;
use crate::geometry::{minimum_rectangle, Moments, Plane, PlaneFrame, Vec3};

/// Planes of the scene that are looked at.
const MAX_SCENE_PLANES: usize = 14;
/// A plane of the scene covers at least this.
const MIN_SCENE_PLANE_M2: f64 = 0.02;
/// How far from the first cell of a triple the other two may lie, metres.
const SCENE_REACH_M: f64 = 0.25;
/// Cells of the scene, at most.
const MAX_SCENE_SITES: usize = 60_000;
/// Noise below this many times the expected is as expected.
const AS_EXPECTED: f64 = 1.5;
/// Noise is taken to be at most this many times the expected.
const MAX_NOISE_SCALE: f64 = 8.0;
/// Rank of the typical cell among the largest plane's.
const TYPICAL_CELL: f64 = 0.4;
/// Median of the absolute value of a standard normal variable.
const NORMAL_MEDIAN: f64 = 0.6745;

/// The larger planes of a whole scene, on coarse sites.
pub struct ScenePlanes {
    pub sites: Sites,
    pub planes: Vec<SitePlane>,
    /// Whether each plane is too large to be a thing's.
    pub is_large: Vec<bool>,
}

impl ScenePlanes {
    /// Finds them, and how noisy the readings are: where the largest plane's scatter more than the settings say, their
    /// noise is taken to be that much larger and the search begins anew.
    pub fn find(readings: &mut Readings, indices: &[u32], settings: &PerceptionSettings) -> Self {
        let mut scale = 1.0;
        loop {
            let scene = Self::find_once(readings, indices, settings);
            let more = scene.excess_noise(readings);
            if more < AS_EXPECTED || scale >= MAX_NOISE_SCALE {
                return scene;
            }
            scale = (scale * more).min(MAX_NOISE_SCALE);
            readings.scale_noise(scale);
        }
    }

    fn find_once(readings: &Readings, indices: &[u32], settings: &PerceptionSettings) -> Self {
        let sites = Sites::new(readings, indices, settings.scene_cell_m, MAX_SCENE_SITES);
        let planes = search(&sites, settings).run();
        Self::new(sites, planes, settings)
    }

    /// Of planes that are known already, largest first: each with its largest piece.
    pub fn of_planes(readings: &Readings, indices: &[u32], known: &[Plane], settings: &PerceptionSettings) -> Self {
        let sites = Sites::new(readings, indices, settings.scene_cell_m, MAX_SCENE_SITES);
        let search = search(&sites, settings);
        let mut free = vec![true; sites.len()];
        let mut planes = Vec::new();
        for found in known {
            if planes.len() == MAX_SCENE_PLANES {
                break;
            }
            if let Some(plane) = search.refine(found, &free) {
                plane.sites.iter().for_each(|&s| free[s as usize] = false);
                planes.push(plane);
            }
        }
        Self::new(sites, planes, settings)
    }

    fn new(sites: Sites, planes: Vec<SitePlane>, settings: &PerceptionSettings) -> Self {
        let is_large = planes.iter().map(|p| longest_side(&sites, p) > settings.largest_thing_m).collect();
        Self { sites, planes, is_large }
    }

    /// Least squares over a plane's readings within tolerance, not whole cells; the normal keeps its side.
    pub fn refit(&self, readings: &Readings, found: usize, oriented: &Plane) -> Plane {
        let mut plane = *oriented;
        for _ in 0..2 {
            let mut moments = Moments::default();
            for &s in &self.planes[found].sites {
                let points = self.sites.voxels.members_of(s as usize).iter().map(|&i| readings.point(i));
                let near = points.filter(|p| plane.height_of(p).abs() <= readings.tolerance_m(p));
                near.for_each(|p| moments.add_point(&p));
            }
            if let Some((fitted, _)) = moments.fit_plane() {
                plane = if fitted.normal.dot(&plane.normal) < 0.0 { fitted.flipped() } else { fitted };
            }
        }
        plane
    }

    /// Scatter of the readings over and under the largest plane's cells, in units of the expected (eq. 28).
    ///
    /// The typical cell's median: what stands on the plane or at its border spoils the fewer cells.
    fn excess_noise(&self, readings: &Readings) -> f64 {
        let Some(largest) = self.planes.iter().reduce(|a, b| if b.sites.len() > a.sites.len() { b } else { a }) else {
            return 1.0;
        };
        let mut medians: Vec<f64> =
            largest.sites.iter().map(|&s| self.cell_scatter(readings, &largest.plane, s as usize)).collect();
        quantile(&mut medians, TYPICAL_CELL) / NORMAL_MEDIAN
    }

    /// Median height of the readings over and under a cell, without sign, in standard deviations.
    fn cell_scatter(&self, readings: &Readings, plane: &Plane, site: usize) -> f64 {
        let (center, radius_m) = (self.sites.surfels.centers[site], 0.5 * self.sites.voxels.size_m);
        let cells = self.sites.surfels.neighbours.of(site).iter().map(|&n| n as usize).chain([site]);
        let points = cells.flat_map(|s| self.sites.voxels.members_of(s)).map(|&i| readings.point(i));
        let beside = |p: &Vec3| (p - center - plane.normal * plane.normal.dot(&(p - center))).norm() <= radius_m;
        let mut scatter: Vec<f64> =
            points.filter(beside).map(|p| plane.height_of(&p).abs() / readings.sigma_m(&p)).collect();
        quantile(&mut scatter, 0.5)
    }
}

fn search<'a>(sites: &'a Sites, settings: &'a PerceptionSettings) -> PlaneSearch<'a> {
    PlaneSearch {
        sites,
        settings,
        reach_m: SCENE_REACH_M,
        worth: vec![1.0; sites.len()],
        min_worth: (MIN_SCENE_PLANE_M2 / sites.voxels.size_m.powi(2)).max(6.0),
        max_planes: MAX_SCENE_PLANES,
        seed: 1,
    }
}

/// The value below which this share lies; 0 of none.
fn quantile(values: &mut [f64], share: f64) -> f64 {
    let place = (values.len() as f64 * share) as usize;
    if place < values.len() {
        *values.select_nth_unstable_by(place, f64::total_cmp).1
    } else {
        0.0
    }
}

fn longest_side(sites: &Sites, plane: &SitePlane) -> f64 {
    let frame = PlaneFrame::new(&plane.plane, &sites.surfels.centers[plane.sites[0] as usize]);
    let footprint: Vec<_> = plane.sites.iter().map(|&s| frame.to_plane(&sites.surfels.centers[s as usize])).collect();
    minimum_rectangle(&footprint).map_or(0.0, |r| r.size()[0].max(r.size()[1]))
}
