use super::grid::perceive_on_grid;
use super::ransac::perceive_by_ransac;
use super::voxel::perceive_on_voxels;
use super::{PerceptionSettings, PlaneFinder, Scene};
use crate::cloud::CloudView;
use crate::error::Result;

/// From a cloud to its planar segments, by the front end that the settings name.
///
/// Equal input gives equal bits, on any number of threads.
///
/// # Errors
/// `InputError` where the cloud has no finite reading, several directions could be up, or the support is seen from below.
pub fn perceive(cloud: &CloudView, settings: &PerceptionSettings) -> Result<Scene> {
    match settings.planes {
        PlaneFinder::Ransac => perceive_by_ransac(cloud, settings),
        PlaneFinder::Grid if cloud.is_organized() => perceive_on_grid(cloud, settings),
        PlaneFinder::Grid => perceive_on_voxels(cloud, settings),
    }
}
