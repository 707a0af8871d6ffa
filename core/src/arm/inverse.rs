use std::f64::consts::TAU;

use arrayvec::ArrayVec;

use super::branches::{Branch, Branches, Singular};
use super::model::Arm;
use super::opw::Opw;
use super::positions::JointPositions;
use super::wraps::{wraps, MAX_WRAPS};
use crate::geometry::Rigid;

/// Ways to reach one tool pose, at most: 8 branches in all their wraps (a joint of +-360 degrees has 3, one of +-190 has 2).
pub const MAX_SOLUTIONS: usize = 64;

/// Joint positions within limits that put the tool where it was asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    pub positions: JointPositions,
    /// The closed form's branch (see [`Branch`]); 0 for a numeric solution.
    pub branch: u8,
    pub singular: Singular,
}

/// On the stack: the planner asks millions of times.
pub type Solutions = ArrayVec<Solution, MAX_SOLUTIONS>;

impl Arm {
    /// All joint positions within limits that reach a tool pose, by branch, then by position: every branch and every wrap where the
    /// inverse is a closed form, else what the numeric search finds from the arm's ready pose and its fixed starts.
    pub fn inverse(&self, base_from_tool: &Rigid) -> Solutions {
        match &self.opw {
            Some(opw) => self.closed_form(opw, base_from_tool),
            None => self.numeric_inverse(base_from_tool, &self.ready),
        }
    }

    /// As [`Arm::inverse`]; a numeric search starts from `near`, and its solution nearest to that comes first.
    pub fn inverse_near(&self, base_from_tool: &Rigid, near: &JointPositions) -> Solutions {
        match &self.opw {
            Some(opw) => self.closed_form(opw, base_from_tool),
            None => self.numeric_inverse(base_from_tool, near),
        }
    }

    pub fn has_closed_form(&self) -> bool {
        self.opw.is_some()
    }

    /// The closed form's branches, limits aside; none where the pose is out of reach or there is no closed form.
    pub fn branches(&self, base_from_tool: &Rigid) -> Branches {
        let flange = base_from_tool.then(&self.gripper.flange_from_tool().inverse());
        self.opw.as_ref().map(|opw| opw.branches(&flange)).unwrap_or_default()
    }

    /// The joint that a branch cannot turn far enough, and by how much it is short at the least, rad.
    pub fn joint_short_of(&self, branch: &Branch) -> Option<(usize, f64)> {
        let short = |k: usize| {
            let joint = &self.joints[k];
            let lower = joint.lower_rad + (branch.angles_rad[k] - joint.lower_rad).rem_euclid(TAU);
            (lower - joint.upper_rad).min(joint.lower_rad - (lower - TAU))
        };
        let worst = (0..self.axes()).map(|k| (k, short(k))).max_by(|a, b| a.1.total_cmp(&b.1))?;
        (worst.1 > 0.0).then_some(worst)
    }

    fn closed_form(&self, opw: &Opw, base_from_tool: &Rigid) -> Solutions {
        let flange = base_from_tool.then(&self.gripper.flange_from_tool().inverse());
        let mut found = Solutions::new();
        for branch in &opw.branches(&flange) {
            self.add_wraps(branch, &mut found);
        }
        found
    }

    /// Every combination of the joints' wraps within limits, first joint's slowest.
    fn add_wraps(&self, branch: &Branch, found: &mut Solutions) {
        let mut choices: [ArrayVec<f64, MAX_WRAPS>; 6] = Default::default();
        for (k, joint) in self.joints.iter().enumerate() {
            choices[k] = wraps(branch.angles_rad[k], joint.lower_rad, joint.upper_rad);
            if choices[k].is_empty() {
                return;
            }
        }
        let count: usize = choices.iter().map(|choice| choice.len()).product();
        for number in 0..count {
            let mut positions = JointPositions::zeros(choices.len());
            let mut rest = number;
            for (k, choice) in choices.iter().enumerate().rev() {
                positions[k] = choice[rest % choice.len()];
                rest /= choice.len();
            }
            found.push(Solution { positions, branch: branch.number, singular: branch.singular });
        }
    }
}
