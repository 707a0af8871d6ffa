//! Readings of a view whose place is known only so well: the place that suits them best is found with the body, and left out of
//! what is told (eq. 99).

use nalgebra::{DMatrix, Isometry3, Matrix6, SVector, Translation3, UnitQuaternion, Vector6};

use super::body::{FittedBody, Parameters};
use super::layout::{PARAMETER_COUNT, POSE_COUNT};
use super::linearized::Linearized;
use super::problem::{add_part, for_each_row};
use super::readings::PartReadings;
use crate::geometry::Vec3;

/// How well a view's place is known, at the object: standard deviations about each and along each axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlaceSigma {
    pub turn_rad: f64,
    pub shift_m: f64,
}

/// Readings of one further view, told in the frame of the first by its place as it was given.
#[derive(Debug, Clone)]
pub struct OtherView {
    pub parts: Vec<PartReadings>,
    pub sigma: PlaceSigma,
}

/// Steps to the place that suits the readings best, at most, and the gain in the objective below which one is the last.
const STEPS: usize = 20;
const LEAST_GAIN: f64 = 1e-8;

impl OtherView {
    /// The small motion of its readings, in the object's frame, that suits this body best; found from `start`.
    pub fn motion(&self, body: &FittedBody, start: &Isometry3<f64>, cut: f64) -> Isometry3<f64> {
        let mut motion = *start;
        for _ in 0..STEPS {
            let (mut gradient, mut curvature) = (self.prior_gradient(&motion), self.prior_curvature());
            for part in &self.parts {
                for_each_row(part, body, Some(&motion), cut, |row, weight| {
                    let by = SVector::<f64, POSE_COUNT>::from_column_slice(&row.slots[..POSE_COUNT]);
                    // A motion of the readings is one of the body the other way.
                    gradient -= by * (weight * row.value);
                    curvature += by * by.transpose() * weight;
                });
            }
            let Some(factor) = curvature.cholesky() else { break };
            let step = -factor.solve(&gradient);
            motion = step_of(&step) * motion;
            if -gradient.dot(&step) < 2.0 * LEAST_GAIN {
                break;
            }
        }
        motion
    }

    /// Adds what its readings say, their motion being this, which suits them (eq. 99).
    pub fn add_to(&self, sums: &mut Linearized, body: &FittedBody, motion: &Isometry3<f64>, cut: f64) {
        let mut own = Linearized::zeros();
        for part in &self.parts {
            add_part(&mut own, part, body, Some(motion), cut);
        }
        let prior = self.prior_gradient(motion);
        let full = |i: usize, j: usize| own.curvature[(i.max(j), i.min(j))];
        let of_place = Matrix6::from_fn(full) + self.prior_curvature();
        let coupled = DMatrix::from_fn(PARAMETER_COUNT, POSE_COUNT, full);
        let Some(factor) = of_place.cholesky() else { return };
        // A motion of the readings is one of the body the other way.
        let left: Vector6<f64> = prior - own.gradient.fixed_rows::<POSE_COUNT>(0);
        let mut gradient = own.gradient + SVector::from_column_slice((&coupled * factor.solve(&left)).as_slice());
        let mut curvature = DMatrix::from_fn(PARAMETER_COUNT, PARAMETER_COUNT, full);
        curvature -= &coupled * factor.solve(&coupled.transpose());
        turn_pose(&mut gradient, &mut curvature, motion);
        sums.cost += own.cost + 0.5 * offset_of(motion).dot(&prior);
        sums.gradient += gradient;
        sums.curvature += curvature;
    }

    fn prior_curvature(&self) -> Matrix6<f64> {
        let (turn, shift) = (self.sigma.turn_rad.powi(-2), self.sigma.shift_m.powi(-2));
        Matrix6::from_diagonal(&Vector6::new(turn, turn, turn, shift, shift, shift))
    }

    fn prior_gradient(&self, motion: &Isometry3<f64>) -> Vector6<f64> {
        self.prior_curvature() * offset_of(motion)
    }
}

/// From steps of the body that readings see where they were moved to, to steps before that motion.
fn turn_pose(gradient: &mut Parameters, curvature: &mut DMatrix<f64>, motion: &Isometry3<f64>) {
    let turn = motion.rotation.to_rotation_matrix().into_inner();
    let mut adjoint = Matrix6::zeros();
    adjoint.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
    adjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
    adjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&(motion.translation.vector.cross_matrix() * turn));
    let turned: Vector6<f64> = adjoint.transpose() * gradient.fixed_rows::<POSE_COUNT>(0);
    gradient.fixed_rows_mut::<POSE_COUNT>(0).copy_from(&turned);
    let columns = curvature.columns(0, POSE_COUNT) * adjoint;
    curvature.columns_mut(0, POSE_COUNT).copy_from(&columns);
    let rows = adjoint.transpose() * curvature.rows(0, POSE_COUNT);
    curvature.rows_mut(0, POSE_COUNT).copy_from(&rows);
}

fn step_of(step: &Vector6<f64>) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_scaled_axis(Vec3::new(step[0], step[1], step[2]));
    Isometry3::from_parts(Translation3::new(step[3], step[4], step[5]), turn)
}

fn offset_of(motion: &Isometry3<f64>) -> Vector6<f64> {
    let (turn, shift) = (motion.rotation.scaled_axis(), motion.translation.vector);
    Vector6::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
}
