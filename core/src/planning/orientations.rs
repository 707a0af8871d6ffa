//! A grid of tool orientations, the same in every box's frame, and which are near which.

use std::sync::OnceLock;

use nalgebra::{Matrix3, Quaternion, Rotation3, UnitQuaternion};

use crate::geometry::Vec3;

/// The points of an octahedron cut this fine, on the sphere: 4 n^2 + 2 tool directions, the flap's own axes among them.
const COARSE: i32 = 4;
const FINE: i32 = 6;
/// Turns about the tool's axis.
const ROLLS: usize = 8;
/// Orientations at most this far apart follow one another, rad: a step of the grid either way.
const NEAR_RAD: f64 = 0.80;

/// Rotations flap_from_tool of a closed flap, and for each those within reach of one step, itself first.
pub struct OrientationGrid {
    pub rotations: Vec<UnitQuaternion<f64>>,
    pub near: Vec<Vec<(usize, f64)>>,
}

impl OrientationGrid {
    /// The grid of quick searches; made once.
    pub fn coarse() -> &'static Self {
        static GRID: OnceLock<OrientationGrid> = OnceLock::new();
        GRID.get_or_init(|| Self::new(COARSE))
    }

    /// That of searches where others failed; made once.
    pub fn fine() -> &'static Self {
        static GRID: OnceLock<OrientationGrid> = OnceLock::new();
        GRID.get_or_init(|| Self::new(FINE))
    }

    fn new(fineness: i32) -> Self {
        let mut rotations = Vec::new();
        for direction in tool_directions(fineness) {
            for roll in 0..ROLLS {
                let roll_rad = std::f64::consts::TAU * roll as f64 / ROLLS as f64;
                rotations.push(pointing(&direction, roll_rad));
            }
        }
        let near = rotations.iter().map(|from| nearest_first(from, &rotations)).collect();
        Self { rotations, near }
    }

    pub fn size(&self) -> usize {
        self.rotations.len()
    }

    /// Of two orientations half a turn about the tool's axis apart, in which a gripper takes up the same room: is it the second?
    pub fn is_half_turned(orientation: usize) -> bool {
        orientation % ROLLS >= ROLLS / 2
    }
}

fn nearest_first(from: &UnitQuaternion<f64>, all: &[UnitQuaternion<f64>]) -> Vec<(usize, f64)> {
    let mut found: Vec<(usize, f64)> = all.iter().map(|to| from.angle_to(to)).enumerate().collect();
    found.retain(|&(_, angle_rad)| angle_rad <= NEAR_RAD);
    found.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
    found
}

fn tool_directions(n: i32) -> Vec<Vec3> {
    let mut found = Vec::new();
    for x in -n..=n {
        for y in -n..=n {
            let rest = n - x.abs() - y.abs();
            if rest < 0 {
                continue;
            }
            for z in if rest == 0 { vec![0] } else { vec![-rest, rest] } {
                found.push(Vec3::new(f64::from(x), f64::from(y), f64::from(z)).normalize());
            }
        }
    }
    found
}

/// The tool's z along `direction`, its x turned by `roll_rad` from the axis that is squarest to it.
fn pointing(direction: &Vec3, roll_rad: f64) -> UnitQuaternion<f64> {
    let reference = if direction.x.abs() < 0.9 { Vec3::x() } else { Vec3::y() };
    let x = (reference - direction * reference.dot(direction)).normalize();
    let upright = Matrix3::from_columns(&[x, direction.cross(&x), *direction]);
    let rolled = upright * Rotation3::from_axis_angle(&Vec3::z_axis(), roll_rad).matrix();
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rolled))
}

/// A weighted mean of rotations that are near one another: of their quaternions, each on the side of the first.
pub fn blend(parts: &[(UnitQuaternion<f64>, f64)]) -> UnitQuaternion<f64> {
    let first = parts[0].0.into_inner();
    let sum = parts.iter().fold(Quaternion::new(0.0, 0.0, 0.0, 0.0), |sum, (rotation, weight)| {
        let q = rotation.into_inner();
        sum + q * if q.dot(&first) < 0.0 { -weight } else { *weight }
    });
    UnitQuaternion::from_quaternion(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_turned_orientations_are_others_turned_by_half_a_turn() {
        let grid = OrientationGrid::fine();
        let half = UnitQuaternion::from_axis_angle(&Vec3::z_axis(), std::f64::consts::PI);
        let turned = (0..grid.size()).filter(|&k| OrientationGrid::is_half_turned(k));
        let pairs = turned.filter(|&k| {
            let other = k - ROLLS / 2;
            !OrientationGrid::is_half_turned(other)
                && (grid.rotations[other] * half).angle_to(&grid.rotations[k]) < 1e-6
        });
        assert_eq!(2 * pairs.count(), grid.size());
    }

    #[test]
    fn every_direction_has_neighbours_and_its_own_axes_are_there() {
        let grids = [(OrientationGrid::coarse(), 66), (OrientationGrid::fine(), 146)].map(|(grid, directions)| {
            assert_eq!(grid.size(), directions * ROLLS);
            for (k, near) in grid.near.iter().enumerate() {
                assert_eq!(near[0].0, k);
                let others = near.iter().filter(|(other, _)| other / ROLLS != k / ROLLS);
                assert!(others.count() >= 3, "{k}: {near:?}");
            }
            for axis in [Vec3::x(), -Vec3::x(), Vec3::y(), -Vec3::y(), Vec3::z(), -Vec3::z()] {
                assert!(grid.rotations.iter().any(|r| (r * Vec3::z() - axis).norm() < 1e-12));
            }
        });
        assert_eq!(grids.len(), 2);
    }
}
