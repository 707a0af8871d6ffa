//! What is good about a posture, which of several is nearest, and why there is none.

use super::reason::Obstacle;
use crate::arm::{Arm, JointPositions, Solutions};
use crate::geometry::Rigid;

/// Joints within this of a limit are near it.
const LIMIT_NEAR_RAD: f64 = 0.15;

/// The solution whose widest turn from `from` is the least, and that turn, rad.
pub fn nearest(solutions: &Solutions, from: &JointPositions) -> Option<(JointPositions, f64)> {
    let widest = |to: &JointPositions| to.iter().zip(from.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let all = solutions.iter().map(|solution| (solution.positions, widest(&solution.positions)));
    all.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// Why no posture reaches a tool pose: the joint that is short, in the branch that is the least short, or the reach.
pub fn out_of_reach(arm: &Arm, base_from_tool: &Rigid) -> Obstacle {
    let branches = arm.branches(base_from_tool);
    let short = branches.iter().filter_map(|branch| arm.joint_short_of(branch));
    match short.min_by(|a, b| a.1.total_cmp(&b.1)) {
        Some((joint, _)) => Obstacle::Limit { joint: arm.joints[joint].name.clone() },
        None => Obstacle::Reach,
    }
}

/// Grows near the joints' limits (eq. 85).
pub fn limit_penalty(arm: &Arm, positions: &JointPositions) -> f64 {
    let joints = arm.joints.iter().zip(positions.iter());
    let margins = joints.map(|(joint, &q)| (q - joint.lower_rad).min(joint.upper_rad - q));
    margins.map(|margin| (1.0 - margin / LIMIT_NEAR_RAD).max(0.0)).sum()
}
