use crate::error::{InputError, Result};
use crate::geometry::Vec3;
use serde::Deserialize;
use serde_json::{Map, Value};

/// Which front end finds the planes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlaneFinder {
    /// The paper's chain: support, Euclidean clusters, sequential RANSAC.
    Ransac,
    /// Ours: planes grow on the image grid, or on voxels where the cloud has none.
    Grid,
}

impl PlaneFinder {
    pub const ALL: [Self; 2] = [Self::Ransac, Self::Grid];

    /// What settings call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ransac => "ransac",
            Self::Grid => "grid",
        }
    }
}

/// What perception can be told; every default of the algorithm is here and nowhere else.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PerceptionSettings {
    pub planes: PlaneFinder,
    /// The direction away from the support, input's frame; `None` finds it.
    #[serde(skip)]
    pub up: Option<Vec3>,
    /// How far the support's normal may lean from a given `up`.
    pub up_tolerance_rad: f64,
    /// Standard deviation of a reading at range r is `sigma_floor_m + sigma_at_1m_m * r^2` (r in metres): stereo and
    /// structured light see disparity, so their error grows with the square of the range.
    pub sigma_floor_m: f64,
    pub sigma_at_1m_m: f64,
    /// A reading belongs to a plane within `tolerance_floor_m + tolerance_sigmas * sigma`.
    pub tolerance_floor_m: f64,
    pub tolerance_sigmas: f64,
    /// Cells of the search for the support and for walls of the room.
    pub scene_cell_m: f64,
    /// A plane that reaches farther than this is part of the room, not of a thing.
    pub largest_thing_m: f64,
    /// Readings farther above the support than this are not looked at.
    pub tallest_thing_m: f64,
    /// Readings nearer than this to each other belong to one thing; it grows with the noise.
    pub cluster_gap_m: f64,
    /// Clusters below this many readings are dropped.
    pub min_cluster_points: usize,
    /// Segments below this many readings are dropped.
    pub min_segment_points: usize,
    /// Segments whose readings cover less are dropped.
    pub min_segment_area_m2: f64,
    /// Planes of one cluster, at most.
    pub max_planes_per_cluster: usize,
    /// Triples drawn for each plane.
    pub ransac_draws: usize,
    /// How far from the first reading of a triple the other two may lie.
    pub ransac_reach_m: f64,
    /// A reading whose surroundings lean more than this from a plane does not belong to it.
    pub normal_tolerance_rad: f64,
    /// Planes whose rms is more than this share of the tolerance are no planes (uniformly spread readings have 0.577).
    pub max_rms_share: f64,
    /// Readings within this height of the support may be the base of a box.
    pub base_band_m: f64,
    /// By how much the walls' outline is shrunk before it encloses a base.
    pub base_margin_m: f64,
    /// Walls stand within this angle of upright.
    pub wall_tilt_rad: f64,
    /// A segment is folded in two along a crease of at least this angle.
    pub min_crease_rad: f64,
    /// Either side of a crease reaches at least this far from it.
    pub min_crease_side_m: f64,
    /// The fold must leave less than this share of the flat fit's squared residuals.
    pub max_crease_residual_share: f64,
}

impl Default for PerceptionSettings {
    fn default() -> Self {
        Self {
            planes: PlaneFinder::Grid,
            up: None,
            up_tolerance_rad: 15f64.to_radians(),
            sigma_floor_m: 0.0006,
            sigma_at_1m_m: 0.0016,
            tolerance_floor_m: 0.0025,
            tolerance_sigmas: 2.2,
            scene_cell_m: 0.04,
            largest_thing_m: 1.3,
            tallest_thing_m: 1.6,
            cluster_gap_m: 0.02,
            min_cluster_points: 60,
            min_segment_points: 90,
            min_segment_area_m2: 0.0006,
            max_planes_per_cluster: 40,
            ransac_draws: 300,
            ransac_reach_m: 0.06,
            normal_tolerance_rad: 35f64.to_radians(),
            max_rms_share: 0.5,
            base_band_m: 0.02,
            base_margin_m: 0.012,
            wall_tilt_rad: 25f64.to_radians(),
            min_crease_rad: 6f64.to_radians(),
            min_crease_side_m: 0.025,
            max_crease_residual_share: 0.7,
        }
    }
}

impl PerceptionSettings {
    /// The defaults with some values replaced by name.
    ///
    /// # Errors
    /// `InputError` naming a setting that does not exist or a value of the wrong kind.
    pub fn with_overrides(overrides: Map<String, Value>) -> Result<Self> {
        serde_json::from_value(Value::Object(overrides))
            .map_err(|e| InputError::new(e.to_string()).in_source("perception settings"))
    }

    /// Standard deviation of a reading, metres, at this range (eq. 26, as expected).
    pub fn sigma_m(&self, range_m: f64) -> f64 {
        self.sigma_floor_m + self.sigma_at_1m_m * range_m * range_m
    }

    /// Largest distance from a plane of a reading that belongs to it (eq. 27), metres, given its standard deviation.
    pub fn tolerance_m(&self, sigma_m: f64) -> f64 {
        self.tolerance_floor_m + self.tolerance_sigmas * sigma_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_know_each_plane_finder_by_its_name() {
        for finder in PlaneFinder::ALL {
            let overrides = Map::from_iter([("planes".to_owned(), Value::from(finder.name()))]);
            assert_eq!(PerceptionSettings::with_overrides(overrides).unwrap().planes, finder);
        }
    }
}
