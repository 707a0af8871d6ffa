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

/// The rectangle's corners from its hinge edge on: that edge along the hinge's direction, then the two free corners, going
/// round. Of the two edges that run along the hinge, the one whose middle is nearer to it.
pub fn corners_from_hinge(rectangle: &Rectangle, hinge: &HingeEdge) -> [Vec3; 4] {
    let distance = |middle: Vec3| (middle - hinge.middle()).norm();
    corners_from_edge(rectangle, &(hinge.end - hinge.start), distance)
}

/// The same for a panel that leaves its hinge along `direction`: of the two edges along `axis`, the one it leaves behind.
pub fn corners_leaving(rectangle: &Rectangle, axis: &Vec3, direction: &Vec3) -> [Vec3; 4] {
    corners_from_edge(rectangle, axis, |middle| middle.dot(direction))
}

/// The corners from the edge on that runs along `along` and whose middle has the lesser `order`.
fn corners_from_edge(rectangle: &Rectangle, along: &Vec3, order: impl Fn(Vec3) -> f64) -> [Vec3; 4] {
    let run = |k: usize| {
        let (a, b) = rectangle.edge(k);
        (b - a).try_normalize(1e-9).map_or(0.0, |direction| direction.dot(along))
    };
    let rank = |k: usize| {
        let (a, b) = rectangle.edge(k);
        order((a + b) / 2.0)
    };
    let first = usize::from(run(1).abs() > run(0).abs());
    let edge = if rank(first) <= rank(first + 2) { first } else { first + 2 };
    let corner = |offset: usize| rectangle.corners[(edge + offset) % 4];
    if run(edge) >= 0.0 {
        [corner(0), corner(1), corner(2), corner(3)]
    } else {
        [corner(1), corner(0), corner(3), corner(2)]
    }
}

/// Unit direction in which a panel leaves its hinge (eq. 24): in its plane, square to the axis, towards its middle.
pub fn leaving_direction(normal: &Vec3, middle: &Vec3, hinge_point: &Vec3, axis: &Vec3) -> Option<Vec3> {
    let direction = axis.cross(normal).try_normalize(1e-9)?;
    Some(if direction.dot(&(middle - hinge_point)) < 0.0 { -direction } else { direction })
}

/// Angle from `zero` to `direction` about `axis` by the right hand (eq. 25), both square to it, in -pi/2 .. 3 pi/2.
pub fn hinge_angle_rad(zero: &Vec3, direction: &Vec3, axis: &Vec3) -> f64 {
    let angle = axis.dot(&zero.cross(direction)).atan2(zero.dot(direction));
    if angle < -FRAC_PI_2 {
        angle + TAU
    } else {
        angle
    }
}
