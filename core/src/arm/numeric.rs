use nalgebra::{Matrix6, Vector6};

use super::branches::Singular;
use super::inverse::{Solution, Solutions};
use super::jacobian::Jacobian;
use super::model::Arm;
use super::positions::{JointPositions, MAX_AXES};
use crate::geometry::rigid::rotation_vector;
use crate::geometry::Rigid;

/// One base for each joint of the low-discrepancy sequence of starts (Halton's).
const PRIMES: [usize; MAX_AXES] = [2, 3, 5, 7, 11, 13, 17];
/// Singular where the Jacobian's smallest of six singular values is below: per metre and radian.
const NEAR_SINGULAR: f64 = 0.01;

impl Arm {
    /// Solutions within limits from `first` and from fixed starts, the nearest to `first` first; the same each time.
    pub fn numeric_inverse(&self, base_from_tool: &Rigid, first: &JointPositions) -> Solutions {
        let settings = &self.numeric;
        let mut found = Solutions::new();
        for start in 0..settings.starts {
            let positions = if start == 0 { *first } else { self.spread_start(start) };
            let Some(positions) = self.descend(base_from_tool, positions) else { continue };
            let apart = |other: &Solution| distance_rad(&other.positions, &positions) > settings.apart_rad;
            if found.iter().all(apart) {
                found.push(Solution { positions, branch: 0, singular: self.near_singular(&positions) });
            }
            if found.len() >= settings.enough.min(found.capacity()) {
                break;
            }
        }
        found.sort_by(|a, b| distance_rad(&a.positions, first).total_cmp(&distance_rad(&b.positions, first)));
        found
    }

    fn spread_start(&self, number: usize) -> JointPositions {
        let mut positions = JointPositions::zeros(self.axes());
        for (k, joint) in self.joints.iter().enumerate() {
            positions[k] = joint.lower_rad + (joint.upper_rad - joint.lower_rad) * radical_inverse(number, PRIMES[k]);
        }
        positions
    }

    /// Damped least squares within the limits (T. Sugihara, "Solvability-unconcerned inverse kinematics by the Levenberg-Marquardt
    /// method", IEEE Trans. Robotics 2011): the damping is the error's square, so that the last steps are Newton's.
    fn descend(&self, base_from_tool: &Rigid, start: JointPositions) -> Option<JointPositions> {
        let mut positions = start;
        for _ in 0..self.numeric.steps {
            let error = pose_error(base_from_tool, &self.forward(&positions));
            if error.fixed_rows::<3>(0).norm() < self.numeric.tolerance
                && error.fixed_rows::<3>(3).norm() < self.numeric.tolerance
            {
                return Some(positions);
            }
            let step = self.step(&positions, &error)?;
            let longest = step.iter().fold(0.0_f64, |longest, s| longest.max(s.abs()));
            let scale = (self.numeric.longest_step_rad / longest).min(1.0);
            for (k, joint) in self.joints.iter().enumerate() {
                positions[k] = (positions[k] + scale * step[k]).clamp(joint.lower_rad, joint.upper_rad);
            }
        }
        None
    }

    /// A step that leaves joints where they are which stand at a limit and would pass it.
    fn step(&self, positions: &JointPositions, error: &Vector6<f64>) -> Option<[f64; MAX_AXES]> {
        let mut jacobian = self.jacobian(positions);
        let damping = 0.5 * error.norm_squared() + self.numeric.least_damping;
        for _ in 0..=self.axes() {
            let step = damped(&jacobian, error, damping)?;
            let mut held = false;
            for (k, joint) in self.joints.iter().enumerate() {
                let stopped = (positions[k] <= joint.lower_rad && step[k] < 0.0)
                    || (positions[k] >= joint.upper_rad && step[k] > 0.0);
                if stopped {
                    jacobian.column_mut(k).fill(0.0);
                    held = true;
                }
            }
            if !held {
                return Some(step);
            }
        }
        None
    }

    fn near_singular(&self, positions: &JointPositions) -> Singular {
        let jacobian = self.jacobian(positions);
        let squares = (jacobian * jacobian.transpose()).symmetric_eigenvalues();
        let near = squares.min() < NEAR_SINGULAR * NEAR_SINGULAR;
        // Which of the three it is has no meaning for a general arm: all that is known is that it is one.
        Singular { shoulder: near, elbow: near, wrist: near }
    }
}

fn damped(jacobian: &Jacobian, error: &Vector6<f64>, damping: f64) -> Option<[f64; MAX_AXES]> {
    let normal: Matrix6<f64> = jacobian * jacobian.transpose() + Matrix6::identity() * damping;
    let step = jacobian.transpose() * normal.cholesky()?.solve(error);
    Some(std::array::from_fn(|k| step[k]))
}

/// How the tool must move: metres, then the rotation vector, in the base's frame.
fn pose_error(wanted: &Rigid, is: &Rigid) -> Vector6<f64> {
    let shift = wanted.translation - is.translation;
    let turn = rotation_vector(&(wanted.rotation * is.rotation.transpose()));
    Vector6::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
}

fn distance_rad(a: &JointPositions, b: &JointPositions) -> f64 {
    a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The digits of `number` in a base, mirrored at the point: 0..1.
fn radical_inverse(mut number: usize, base: usize) -> f64 {
    let (mut value, mut place) = (0.0, 1.0 / base as f64);
    while number > 0 {
        value += (number % base) as f64 * place;
        number /= base;
        place /= base as f64;
    }
    value
}
