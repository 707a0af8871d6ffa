use super::super::readings::Readings;
use super::surfels::Surfels;
use super::voxels::{Neighbours, Voxels};
use crate::geometry::{Moments, Vec3};

/// Cells with at least this many readings around them have a normal.
const MIN_POINTS_FOR_NORMAL: f64 = 12.0;
/// Surroundings are flat where the smallest variance is below this share of the middle one.
const FLAT_VARIANCE_SHARE: f64 = 0.12;

/// Cells of a set of readings, each with what plane search needs of it: thousands instead of hundreds of thousands.
#[derive(Debug, Clone)]
pub struct Sites {
    pub voxels: Voxels,
    pub moments: Vec<Moments>,
    /// Centres are means of the cells' readings, surroundings the cells that touch.
    pub surfels: Surfels,
}

impl Sites {
    /// Cells of `size_m` or, where that makes more than `max_cells` of them, of twice, four times ... the size.
    pub fn new(readings: &Readings, indices: &[u32], size_m: f64, max_cells: usize) -> Self {
        let voxels = Voxels::new(readings, indices, size_m, max_cells);
        let neighbours = voxels.neighbours();
        let moments: Vec<Moments> = (0..voxels.len()).map(|c| cell_moments(readings, voxels.members_of(c))).collect();
        let centers: Vec<Vec3> = moments.iter().map(Moments::mean).collect();
        let tolerance_m = centers.iter().map(|c| readings.tolerance_m(c)).collect();
        let normals = (0..voxels.len()).map(|c| surrounding_normal(&moments, &neighbours, c)).collect();
        let surfels = Surfels { cell_m: voxels.size_m, centers, tolerance_m, normals, neighbours };
        Self { voxels, moments, surfels }
    }

    pub fn len(&self) -> usize {
        self.surfels.len()
    }

    pub fn count(&self, site: usize) -> f64 {
        self.moments[site].weight
    }
}

fn cell_moments(readings: &Readings, members: &[u32]) -> Moments {
    let mut moments = Moments::default();
    members.iter().for_each(|&i| moments.add_point(&readings.point(i)));
    moments
}

fn surrounding_normal(moments: &[Moments], neighbours: &Neighbours, site: usize) -> Vec3 {
    let mut around = moments[site];
    neighbours.of(site).iter().for_each(|&n| around.add(&moments[n as usize]));
    if around.weight < MIN_POINTS_FOR_NORMAL {
        return Vec3::zeros();
    }
    match around.principal() {
        Some((variances, directions)) if variances[0] < FLAT_VARIANCE_SHARE * variances[1] => directions[0],
        _ => Vec3::zeros(),
    }
}
