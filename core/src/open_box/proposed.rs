//! Where proposals stand, and against each other.

use super::proposal::Proposal;
use super::upright::is_lying;
use crate::fit::{layout, FittedBody};
use crate::geometry::Vec3;

/// What stands on one support has ways up nearer than this.
const ALIKE_UP_COS: f64 = 0.7;

/// Whether all walls of two proposals are this near to each other.
pub fn alike(a: &Proposal, b: &Proposal, most_m: f64) -> bool {
    let same_axes = a.axes[0].dot(&b.axes[0]) > 0.998 && a.up.dot(&b.up) > 0.9993;
    let near = |x: &[f64; 2], y: &[f64; 2]| (x[0] - y[0]).abs() < most_m && (x[1] - y[1]).abs() < most_m;
    same_axes && near(&a.spans[0], &b.spans[0]) && near(&a.spans[1], &b.spans[1]) && near(&a.heights, &b.heights)
}

/// Whether it is one of a box on its side.
pub fn lies(proposal: &Proposal) -> bool {
    is_lying(&proposal.up)
}

/// Whether one's middle lies in the other.
pub fn overlap(a: &Proposal, b: &Proposal) -> bool {
    let within = |a: &Proposal, b: &Proposal| {
        let middle = middle(b);
        let is_between = |[low, high]: [f64; 2], axis: &Vec3| (low..=high).contains(&axis.dot(&middle));
        // What stands on one support is told apart by where it stands; what lies has no end of its own above.
        let is_alike = a.up.dot(&b.up) > ALIKE_UP_COS;
        (0..2).all(|i| is_between(a.spans[i], &a.axes[i])) && (is_alike || is_between(a.heights, &a.up))
    };
    within(a, b) || within(b, a)
}

/// Whether the middle of one lies in the other.
pub fn lies_upon(proposal: &Proposal, body: &FittedBody) -> bool {
    let [length, width, height] = [layout::LENGTH, layout::WIDTH, layout::HEIGHT].map(|place| body.get(place));
    let (middle, at) = (body.to_input(&(Vec3::z() * (height / 2.0))), body.to_object(&middle(proposal)));
    let is_in_proposal = (0..2).all(|i| {
        let [low, high] = proposal.spans[i];
        (low..=high).contains(&proposal.axes[i].dot(&middle))
    });
    is_in_proposal || (at.x.abs() < length / 2.0 && at.y.abs() < width / 2.0)
}

/// Length, width and height over the boards, m.
pub fn outer_m(proposal: &Proposal) -> [f64; 3] {
    let [x, y] = proposal.spans;
    [x[1] - x[0], y[1] - y[0], proposal.heights[1] - proposal.heights[0]]
}

pub fn middle(proposal: &Proposal) -> Vec3 {
    let half = |span: &[f64; 2]| (span[0] + span[1]) / 2.0;
    let [x, y] = proposal.spans.each_ref().map(half);
    proposal.axes[0] * x + proposal.axes[1] * y + proposal.up * half(&proposal.heights)
}
