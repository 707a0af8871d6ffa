//! Hinges: an edge that a panel turns about, and how far it is turned.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::geometry::{Rectangle, Vec3};

/// A hinge edge from its start to its end, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HingeEdge {
    pub start: Vec3,
    pub end: Vec3,
}

impl HingeEdge {
    pub fn middle(&self) -> Vec3 {
        (self.start + self.end) / 2.0
    }

    /// Unit vector from start to end; `fallback` where the edge has no length.
    pub fn axis(&self, fallback: &Vec3) -> Vec3 {
        (self.end - self.start).try_normalize(1e-9).unwrap_or(*fallback)
    }
}

/// The rectangle's corners from the edge nearest to `hinge` on: that edge along the hinge's direction, then the two free
/// corners, going round.
pub fn corners_from_hinge(rectangle: &Rectangle, hinge: &HingeEdge) -> [Vec3; 4] {
    let misfit = |k: usize, forward: bool| {
        let (a, b) = rectangle.edge(k);
        let (start, end) = if forward { (a, b) } else { (b, a) };
        (start - hinge.start).norm() + (end - hinge.end).norm()
    };
    let (mut edge, mut forward, mut least) = (0, true, f64::INFINITY);
    for (k, is_forward) in (0..4).flat_map(|k| [(k, true), (k, false)]) {
        if misfit(k, is_forward) < least {
            (edge, forward, least) = (k, is_forward, misfit(k, is_forward));
        }
    }
    let corner = |offset: usize| rectangle.corners[(edge + offset) % 4];
    if forward {
        [corner(0), corner(1), corner(2), corner(3)]
    } else {
        [corner(1), corner(0), corner(3), corner(2)]
    }
}

/// Unit direction in which a panel leaves its hinge: in its plane, square to the axis, towards its free edge.
pub fn leaving_direction(corners_from_hinge: &[Vec3; 4], axis: &Vec3) -> Option<Vec3> {
    let [start, end, free_end, free_start] = corners_from_hinge;
    let out = (free_end + free_start - start - end) / 2.0;
    (out - axis * out.dot(axis)).try_normalize(1e-9)
}

/// Angle from `zero` to `direction` about `axis` by the right hand, both square to it, in -pi/2 .. 3 pi/2.
pub fn hinge_angle_rad(zero: &Vec3, direction: &Vec3, axis: &Vec3) -> f64 {
    let angle = axis.dot(&zero.cross(direction)).atan2(zero.dot(direction));
    if angle < -FRAC_PI_2 {
        angle + TAU
    } else {
        angle
    }
}
