use super::eigen::principal;
use super::voxels::Voxels;
use crate::geometry::{Moments, Plane, Vec3};

/// Readings of a voxel and those around it that tell a direction, at least.
const MIN_COUNT: f64 = 8.0;
/// Surroundings are flat where the smallest variance is below this share of the middle one ...
const FLAT_SHARE: f64 = 0.2;
/// ... and a surface, not a line, where the middle one is above this share of the largest.
const BROAD_SHARE: f64 = 0.06;

/// The surroundings of a voxel: itself and those that touch it.
#[derive(Debug, Clone, Copy)]
pub struct Window {
    /// Unit normal of either sign; zero where they are not flat.
    pub normal: Vec3,
    /// Of the readings about their plane, square metres.
    pub variance: f64,
    /// The voxel's readings over those of the fullest among them.
    pub fullness: f64,
}

impl Window {
    pub fn is_flat(&self) -> bool {
        self.normal != Vec3::zeros()
    }
}

/// The window of each voxel.
pub fn windows(voxels: &Voxels) -> Vec<Window> {
    (0..voxels.len()).map(|v| window(voxels, v)).collect()
}

fn window(voxels: &Voxels, voxel: usize) -> Window {
    let around = sum_around(voxels, voxel);
    let fullest =
        voxels.neighbours.of(voxel).iter().map(|&n| voxels.count(n as usize)).fold(voxels.count(voxel), f64::max);
    let fullness = voxels.count(voxel) / fullest;
    if around.weight < MIN_COUNT {
        return Window { normal: Vec3::zeros(), variance: f64::INFINITY, fullness };
    }
    let found = principal(&around.covariance());
    let [least, middle, most] = found.variances;
    let is_flat = least < FLAT_SHARE * middle && middle > BROAD_SHARE * most;
    Window { normal: if is_flat { found.normal } else { Vec3::zeros() }, variance: least, fullness }
}

pub fn sum_around(voxels: &Voxels, voxel: usize) -> Moments {
    let mut around = voxels.moments[voxel];
    voxels.neighbours.of(voxel).iter().for_each(|&n| around.add(&voxels.moments[n as usize]));
    around
}

/// Least-squares plane (eq. 29) and mean square distance from it; `None` where the points span no plane.
pub fn fit(moments: &Moments) -> Option<(Plane, f64)> {
    if moments.weight < 3.0 {
        return None;
    }
    let found = principal(&moments.covariance());
    let [least, middle, most] = found.variances;
    let plane = Plane { normal: found.normal, distance: found.normal.dot(&moments.mean()) };
    (middle > 1e-9 * most && most > 0.0).then_some((plane, least))
}
