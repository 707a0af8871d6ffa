use super::cells::Cells;
use super::merge::angle_rad;
use super::piece::in_space;
use super::regions::{Region, Regions};
use crate::geometry::{PlaneFrame, Vec3};
use nalgebra::{Matrix2, SMatrix, SVector};

/// A surface is round where its radius of curvature is below this, metres. Bent flaps and bulging sides are flatter.
const MAX_RADIUS_M: f64 = 0.33;
/// By so many standard errors must the curvature exceed that; a neighbour's by fewer.
const CERTAINTY: f64 = 2.0;
const NEIGHBOUR_CERTAINTY: f64 = 1.0;
/// Facets of one round thing lean less than this from each other.
const MAX_TURN_RAD: f64 = 0.87;
/// Cells that show curvature, at least, and how full one must be.
const MIN_CELLS: usize = 9;
const MIN_CELL_READINGS: f64 = 8.0;
/// Larger regions are not looked at: no thing's round side looks flat over so many cells.
const MAX_CELLS: usize = 2000;

/// Which regions are facets of round things: bent as a paraboloid of small radius (eq. 56), and beside a facet that bends
/// the same way. Two panels that were taken for one across a fold bend as well, but alone.
pub fn round_facets(cells: &Cells, regions: &Regions, touching: &[(usize, usize)]) -> Vec<bool> {
    let bends: Vec<Option<Bend>> = regions.list.iter().map(|r| bend(cells, r)).collect();
    let mut is_round = vec![false; bends.len()];
    let mut mark = |a: usize, b: usize| {
        let (Some(one), Some(other)) = (&bends[a], &bends[b]) else { return };
        if one.is_round(CERTAINTY) && other.is_round(NEIGHBOUR_CERTAINTY) && one.curvature * other.curvature > 0.0 {
            is_round[a] = true;
        }
    };
    for &(a, b) in touching {
        if angle_rad(&regions.list[a].plane, &regions.list[b].plane) < MAX_TURN_RAD {
            mark(a, b);
            mark(b, a);
        }
    }
    is_round
}

/// The strongest curvature of a region, 1/m, positive where its middle stands out towards the camera, and its error.
struct Bend {
    curvature: f64,
    error: f64,
}

impl Bend {
    fn is_round(&self, certainty: f64) -> bool {
        self.curvature.abs() - certainty * self.error > 1.0 / MAX_RADIUS_M
    }
}

fn bend(cells: &Cells, region: &Region) -> Option<Bend> {
    let full: Vec<u32> =
        region.cells.iter().copied().filter(|&c| cells.moments[c as usize].n >= MIN_CELL_READINGS).collect();
    if full.len() < MIN_CELLS || full.len() > MAX_CELLS {
        return None;
    }
    let plane = &in_space(&region.plane)?;
    let frame = PlaneFrame::new(plane, &mean_point(cells, full[full.len() / 2]));
    let (mut normal, mut right, mut squares) = (SMatrix::<f64, 6, 6>::zeros(), SVector::<f64, 6>::zeros(), 0.0);
    for &cell in &full {
        let p = mean_point(cells, cell);
        let ([a, b], height) = (frame.to_plane(&p), plane.height_of(&p));
        let weight = cells.moments[cell as usize].n;
        let row = SVector::<f64, 6>::from([1.0, a, b, a * a, a * b, b * b]);
        normal += row * row.transpose() * weight;
        right += row * (weight * height);
        squares += weight * height * height;
    }
    let inverse = normal.try_inverse()?;
    let fit = inverse * right;
    let residual = (squares - fit.dot(&right)).max(0.0) / (full.len() - 6) as f64;
    let bend = Matrix2::new(2.0 * fit[3], fit[4], fit[4], 2.0 * fit[5]).symmetric_eigen();
    let k = bend.eigenvalues.iamax();
    let along = bend.eigenvectors.column(k);
    let (a, b) = (along[0], along[1]);
    let gradient = SVector::<f64, 6>::from([0.0, 0.0, 0.0, 2.0 * a * a, 2.0 * a * b, 2.0 * b * b]);
    let error = (gradient.dot(&(inverse * gradient)) * residual).max(0.0).sqrt();
    Some(Bend { curvature: -bend.eigenvalues[k], error })
}

fn mean_point(cells: &Cells, cell: u32) -> Vec3 {
    let m = &cells.moments[cell as usize];
    Vec3::new(m.u, m.v, m.n) / m.q
}
