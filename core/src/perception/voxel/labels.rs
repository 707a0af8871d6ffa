//! Each reading to the nearest plane of its surroundings.

use super::super::PerceptionSettings;
use super::fixed_fit::FixedFit;
use super::surfaces::Surfaces;
use super::voxels::{Voxels, NONE};
use crate::geometry::{Plane, Vec3};

/// A surface's own scatter counts up to this many of the cloud's standard deviations.
const MOST_SIGMAS: f64 = 2.0;

/// The surface of each reading, and what follows from all of them.
pub struct Labels {
    /// Of each reading by place, `NONE` for none.
    pub of_reading: Vec<u32>,
    pub fits: Vec<FixedFit>,
    /// Of each voxel, whether all its readings went to its owner.
    pub is_whole: Vec<bool>,
}

impl Labels {
    pub fn new(
        points: &[[f32; 3]],
        voxel_of: &[u32],
        voxels: &Voxels,
        surfaces: &Surfaces,
        sigma_m: f64,
        settings: &PerceptionSettings,
    ) -> Self {
        let nearby = Nearby::new(voxels, surfaces);
        let planes: Vec<(Plane, f64)> = surfaces
            .list
            .iter()
            .map(|s| (s.plane, settings.tolerance_m(s.variance.sqrt().clamp(sigma_m, MOST_SIGMAS * sigma_m))))
            .collect();
        let mut fits: Vec<FixedFit> = surfaces.list.iter().map(|s| FixedFit::about(&s.moments.mean())).collect();
        let mut went_home = vec![0u32; voxels.len()];
        let label = |(p, &voxel): (&[f32; 3], &u32)| {
            let place = voxels.inside(p);
            let found = nearest(&planes, nearby.of(voxel as usize), &place);
            if found != NONE {
                fits[found as usize].add(&place);
                went_home[voxel as usize] += u32::from(surfaces.owner[voxel as usize] == found);
            }
            found
        };
        let mut of_reading = Vec::with_capacity(points.len());
        of_reading.extend(points.iter().zip(voxel_of).map(label));
        let is_whole = (0..voxels.len()).map(|v| f64::from(went_home[v]) == voxels.count(v)).collect();
        Self { of_reading, fits, is_whole }
    }
}

#[inline]
fn nearest(planes: &[(Plane, f64)], nearby: &[u32], place: &Vec3) -> u32 {
    let mut best = (f64::INFINITY, NONE);
    for &s in nearby {
        let (plane, tolerance_m) = &planes[s as usize];
        let distance_m = plane.height_of(place).abs();
        if distance_m <= *tolerance_m && distance_m < best.0 {
            best = (distance_m, s);
        }
    }
    best.1
}

/// The surfaces of each voxel and of those that touch it, ascending, one list after another.
struct Nearby {
    starts: Vec<u32>,
    ids: Vec<u32>,
}

impl Nearby {
    fn new(voxels: &Voxels, surfaces: &Surfaces) -> Self {
        let (mut starts, mut ids) = (Vec::with_capacity(voxels.len() + 1), Vec::with_capacity(voxels.len()));
        starts.push(0);
        for v in 0..voxels.len() {
            let first = ids.len();
            let owners = voxels.neighbours.of(v).iter().map(|&n| surfaces.owner[n as usize]);
            for owner in owners.chain([surfaces.owner[v]]) {
                if owner != NONE && !ids[first..].contains(&owner) {
                    ids.push(owner);
                }
            }
            ids[first..].sort_unstable();
            starts.push(ids.len() as u32);
        }
        Self { starts, ids }
    }

    #[inline]
    fn of(&self, voxel: usize) -> &[u32] {
        &self.ids[self.starts[voxel] as usize..self.starts[voxel + 1] as usize]
    }
}
